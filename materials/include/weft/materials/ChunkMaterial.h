#pragma once

#include <memory>

#include "weft/scenegraph/Material.h"

namespace weft {

/// A material put together from chunks; the order in which they are set does not matter, their
/// slots do.
///
/// Starts with what surfaces need: a depth test that writes, and back faces culled. Building it
/// touches no GL.
class ChunkMaterial : public Material {
 public:
  ChunkMaterial();

  /// Puts a chunk of the slot's kind into it, or empties it with null.
  void setChunk(unsigned slot, std::shared_ptr<const Chunk> chunk) { state_.set(slot, std::move(chunk)); }
  const State& state() const override { return state_; }

 private:
  State state_;
};

}  // namespace weft
