#include "weft/chunks/BlendChunk.h"

#include <epoxy/gl.h>

namespace weft {

void BlendChunk::activate(GLContext&, unsigned) const {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void BlendChunk::deactivate(GLContext&, unsigned) const {
  glDisable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ZERO);
}

}  // namespace weft
