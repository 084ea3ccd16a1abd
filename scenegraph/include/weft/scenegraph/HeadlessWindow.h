#pragma once

#include <memory>

#include "weft/chunks/GLContext.h"
#include "weft/core/Result.h"

namespace weft {

/// An OpenGL 4.5 core context without a window or a default framebuffer, through EGL: on the first
/// card that gives one, else in software, with Mesa. The environment's LIBGL_ALWAYS_SOFTWARE=1
/// leaves cards alone.
///
/// Several can live side by side; use each on one thread at a time, after makeCurrent().
class HeadlessWindow {
 public:
  /// The new context is current. `debug` asks the driver for complete debug messages, which costs
  /// time. Fails where EGL offers no OpenGL 4.5.
  static Result<std::unique_ptr<HeadlessWindow>> create(bool debug = false);

  /// Deletes all GL objects of the context; no context is current afterwards.
  ~HeadlessWindow();
  HeadlessWindow(const HeadlessWindow&) = delete;
  HeadlessWindow& operator=(const HeadlessWindow&) = delete;

  void makeCurrent();
  GLContext& context() { return *context_; }

 private:
  HeadlessWindow(void* display, void* eglContext) : display_(display), eglContext_(eglContext) {}

  void* display_;     // EGLDisplay
  void* eglContext_;  // EGLContext
  std::unique_ptr<GLContext> context_;
};

}  // namespace weft
