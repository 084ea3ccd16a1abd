#pragma once

#include <memory>

#include "weft/chunks/GLContext.h"
#include "weft/core/Result.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Node.h"
#include "weft/scenegraph/RenderAction.h"

namespace weft {

/// How PassiveWindow::render() leaves GL.
enum class HostState {
  Restored,  ///< as the host had it
  /// as GL starts up, for hosts that set what they need: spares the queries of GLStateGuard
  Defaults,
};

/// Weft in a GL context that another program, the host, has made and draws with: GLFW's,
/// OpenSceneGraph's, Qt's. Core or compatibility profile.
///
/// One a context. Make, use and destroy it with that context current; where none is current any
/// more, its GL objects have gone with their context.
class PassiveWindow {
 public:
  /// Adopts the context that is current. Fails where none is, or one below OpenGL 4.5.
  static Result<std::unique_ptr<PassiveWindow>> adopt();

  /// Draws everything below `root` over what the host has drawn: into its current framebuffer and
  /// viewport, within its scissor, stencil and masks, tested against its depth buffer. Colours are
  /// encoded as sRGB where neither the framebuffer is of floats nor GL encodes for it.
  ///
  /// It does not matter how the host has left GL, but for running queries and transform feedback.
  /// Fails as RenderAction::render() does, and on an incomplete framebuffer.
  Result<void> render(const Node& root, const Camera& camera, HostState after = HostState::Restored);

  GLContext& context() { return context_; }
  const RenderStatistics& statistics() const { return renderer_.statistics(); }

 private:
  PassiveWindow() = default;

  GLContext context_;
  RenderAction renderer_;
};

}  // namespace weft
