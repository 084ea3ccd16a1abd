#pragma once

#include "weft/chunks/Chunk.h"

namespace weft {

/// Whether fragments behind others are dropped, and whether they count for later ones. Default: no
/// test, write.
class DepthChunk : public Chunk {
 public:
  explicit DepthChunk(bool test = true, bool write = true) : test_(test), write_(write) {}

  Slot kind() const override { return DepthSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk& other) const override;

  bool test_;
  bool write_;
};

}  // namespace weft
