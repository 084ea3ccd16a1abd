#include "weft/chunks/PolygonOffsetChunk.h"

#include <epoxy/gl.h>

namespace weft {

void PolygonOffsetChunk::activate(GLContext&, unsigned) const {
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(factor_, units_);
}

void PolygonOffsetChunk::changeFrom(GLContext&, const Chunk&, unsigned) const {
  glPolygonOffset(factor_, units_);
}

void PolygonOffsetChunk::deactivate(GLContext&, unsigned) const {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(0.0f, 0.0f);
}

bool PolygonOffsetChunk::isEqual(const Chunk& other) const {
  const auto& offset = static_cast<const PolygonOffsetChunk&>(other);
  return factor_ == offset.factor_ && units_ == offset.units_;
}

}  // namespace weft
