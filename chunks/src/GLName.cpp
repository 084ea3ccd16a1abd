#include "weft/chunks/GLName.h"

#include <epoxy/egl.h>

namespace weft {

bool hasCurrentContext() {
  // epoxy ends the program without a context. The dispatch of libglvnd answers, for GLX's contexts,
  // too.
  static const auto getString = reinterpret_cast<PFNGLGETSTRINGPROC>(eglGetProcAddress("glGetString"));
  return getString && getString(GL_VERSION);
}

}  // namespace weft
