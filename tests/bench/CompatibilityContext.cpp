#include "CompatibilityContext.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "weft/core/Contract.h"

namespace weft::bench {

CompatibilityContext::CompatibilityContext()
    : display_(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)) {
  eglInitialize(display_, nullptr, nullptr);
  eglBindAPI(EGL_OPENGL_API);
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                               EGL_NONE};
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  makeCurrent();
}

CompatibilityContext::~CompatibilityContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void CompatibilityContext::makeCurrent() {
  const bool current = eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  WEFT_EXPECT(current, "EGL gives a compatibility context");
}

}  // namespace weft::bench
