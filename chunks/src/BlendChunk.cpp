#include "weft/chunks/BlendChunk.h"

#include <epoxy/gl.h>

namespace weft {

void BlendChunk::activate(GLContext& context, unsigned slot) const {
  glEnable(GL_BLEND);
  changeFrom(context, *this, slot);
}

void BlendChunk::changeFrom(GLContext&, const Chunk&, unsigned) const {
  if (kind_ == BlendKind::Tint)
    glBlendFunc(GL_ONE, GL_SRC1_COLOR);
  else
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void BlendChunk::deactivate(GLContext&, unsigned) const {
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);
}

}  // namespace weft
