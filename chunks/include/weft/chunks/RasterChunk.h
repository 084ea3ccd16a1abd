#pragma once

#include "weft/chunks/Chunk.h"

namespace weft {

enum class Culling { None, Back, Front };

/// Which sides of triangles are drawn. Default: both.
class RasterChunk : public Chunk {
 public:
  explicit RasterChunk(Culling culling) : culling_(culling) {}

  Slot kind() const override { return RasterSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk& other) const override;

  Culling culling_;
};

}  // namespace weft
