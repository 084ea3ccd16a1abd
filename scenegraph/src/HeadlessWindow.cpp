#include "weft/scenegraph/HeadlessWindow.h"

// Not <epoxy/egl.h>: its eglGetPlatformDisplay aborts.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <vector>

namespace weft {

namespace {

bool hasExtension(EGLDisplay display, std::string_view name) {
  const char* list = eglQueryString(display, EGL_EXTENSIONS);
  if (!list) return false;
  std::string_view extensions(list);
  while (!extensions.empty()) {
    const std::size_t length = std::min(extensions.find(' '), extensions.size());
    if (extensions.substr(0, length) == name) return true;
    extensions.remove_prefix(std::min(length + 1, extensions.size()));
  }
  return false;
}

std::vector<EGLDisplay> headlessDisplays() {
  std::vector<EGLDisplay> displays;
  if (hasExtension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    displays.push_back(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));

  const auto queryDevices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (hasExtension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") && queryDevices &&
      queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count)) {
    for (EGLint i = 0; i < count; ++i)
      displays.push_back(
          eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr));
  }
  return displays;
}

EGLContext createContext(EGLDisplay display, bool debug) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return EGL_NO_CONTEXT;
  if (!hasExtension(display, "EGL_KHR_no_config_context") ||
      !hasExtension(display, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_API))
    return EGL_NO_CONTEXT;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                               4,
                               EGL_CONTEXT_MINOR_VERSION,
                               5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_DEBUG,
                               debug ? EGL_TRUE : EGL_FALSE,
                               EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

}  // namespace

Result<std::unique_ptr<HeadlessWindow>> HeadlessWindow::create(bool debug) {
  for (const EGLDisplay display : headlessDisplays()) {
    const EGLContext eglContext = createContext(display, debug);
    if (eglContext == EGL_NO_CONTEXT) continue;
    std::unique_ptr<HeadlessWindow> window(new HeadlessWindow(display, eglContext));
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, eglContext)) continue;
    window->context_ = std::make_unique<GLContext>();
    window->context_->reportDebugOutput();
    return window;
  }
  return fail("EGL offers no headless OpenGL 4.5", {},
              "install a driver, or Mesa's software one: libgl1-mesa-dri and libegl-mesa0");
}

HeadlessWindow::~HeadlessWindow() {
  if (context_) {
    makeCurrent();
    context_.reset();
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, eglContext_);
  // The display stays: it is one for the whole process, and ending it would end the contexts of other
  // windows.
}

void HeadlessWindow::makeCurrent() {
  // Which API is current belongs to the thread.
  const bool current =
      eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, eglContext_);
  WEFT_EXPECT(current, "a context is current on one thread at a time");
}

}  // namespace weft
