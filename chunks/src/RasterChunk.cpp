#include "weft/chunks/RasterChunk.h"

#include <epoxy/gl.h>

namespace weft {

void RasterChunk::activate(GLContext&, unsigned) const {
  (culling_ == Culling::None ? glDisable : glEnable)(GL_CULL_FACE);
  glCullFace(culling_ == Culling::Front ? GL_FRONT : GL_BACK);
}

void RasterChunk::changeFrom(GLContext& context, const Chunk& old, unsigned slot) const {
  if (culling_ != static_cast<const RasterChunk&>(old).culling_) activate(context, slot);
}

void RasterChunk::deactivate(GLContext&, unsigned) const {
  glDisable(GL_CULL_FACE);
  glCullFace(GL_BACK);
}

bool RasterChunk::isEqual(const Chunk& other) const {
  return culling_ == static_cast<const RasterChunk&>(other).culling_;
}

}  // namespace weft
