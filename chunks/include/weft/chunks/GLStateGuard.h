#pragma once

#include <memory>

namespace weft {

/// Brings all state of the current GL context that Weft sets or depends on to GL's defaults, which
/// is what rendering starts from: docs/embedding.md has the list. Framebuffer, viewport, scissor,
/// stencil and masks stay.
void resetGLState();

/// Gives the current GL context back as it was: saves, when it is made, the state that
/// resetGLState() resets and all that Weft binds, and restores it when it is destroyed, with the
/// same context current.
///
/// Costs several hundred queries of GL, which a driver answers without waiting for the GPU, but
/// which wait for a driver's own thread.
class GLStateGuard {
 public:
  GLStateGuard();
  ~GLStateGuard();
  GLStateGuard(const GLStateGuard&) = delete;
  GLStateGuard& operator=(const GLStateGuard&) = delete;

 private:
  struct Saved;
  std::unique_ptr<const Saved> saved_;
};

}  // namespace weft
