#include "weft/scenegraph/HeadlessWindow.h"

// Not <epoxy/egl.h>: its eglGetPlatformDisplay aborts.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "EglPlace.h"

namespace weft {

namespace {

bool contains(const char* list, std::string_view name) {
  std::string_view extensions(list ? list : "");
  while (!extensions.empty()) {
    const std::size_t length = std::min(extensions.find(' '), extensions.size());
    if (extensions.substr(0, length) == name) return true;
    extensions.remove_prefix(std::min(length + 1, extensions.size()));
  }
  return false;
}

bool hasExtension(EGLDisplay display, std::string_view name) {
  return contains(eglQueryString(display, EGL_EXTENSIONS), name);
}

/// The devices of all vendors.
std::vector<EGLDeviceEXT> devices() {
  const auto queryDevices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  std::array<EGLDeviceEXT, 64> found{};
  EGLint count = 0;
  if (!hasExtension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") || !queryDevices ||
      !queryDevices(static_cast<EGLint>(found.size()), found.data(), &count))
    return {};
  return {found.begin(), found.begin() + count};
}

bool isSoftware(EGLDeviceEXT device) {
  const auto queryString =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  return queryString && contains(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

std::vector<EglPlace> places() {
  std::vector<EglPlace> found;
  if (hasExtension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    found.push_back({EglPlace::Kind::Surfaceless});
  for (const EGLDeviceEXT device : devices())
    found.push_back({isSoftware(device) ? EglPlace::Kind::SoftwareDevice : EglPlace::Kind::Card, device});
  return found;
}

/// Whether Mesa is told to draw in software; then so are all.
bool softwareIsAskedFor() {
  const char* value = std::getenv("LIBGL_ALWAYS_SOFTWARE");
  return value && *value && std::string_view("0nNfF").find(*value) == std::string_view::npos;
}

EGLDisplay displayAt(const EglPlace& place) {
  if (place.kind == EglPlace::Kind::Surfaceless)
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  return eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, place.device, nullptr);
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
  for (const EglPlace& place : inOrderOfTrying(places(), softwareIsAskedFor())) {
    const EGLDisplay display = displayAt(place);
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
  // The display stays: it is one for the whole process, and ending it would end the contexts of
  // other windows.
}

void HeadlessWindow::makeCurrent() {
  // Which API is current belongs to the thread.
  const bool current =
      eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, eglContext_);
  WEFT_EXPECT(current, "a context is current on one thread at a time");
}

}  // namespace weft
