#pragma once

#include "weft/chunks/Chunk.h"

namespace weft {

/// Moves triangles in depth, but not in the picture, so that what lies on a surface does not
/// flicker with it: by `factor` x their steepness in depth + `units` x the smallest difference that
/// the depth buffer tells apart. Below 0: towards the viewer. Default: not moved.
class PolygonOffsetChunk : public Chunk {
 public:
  PolygonOffsetChunk(float factor, float units) : factor_(factor), units_(units) {}

  Slot kind() const override { return PolygonOffsetSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

 private:
  bool isEqual(const Chunk& other) const override;

  float factor_;
  float units_;
};

}  // namespace weft
