#pragma once

#include <glm/vec4.hpp>
#include <memory>

#include "weft/chunks/GLContext.h"
#include "weft/core/Result.h"
#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Node.h"
#include "weft/scenegraph/RenderTarget.h"

namespace weft {

struct RenderOptions {
  glm::vec4 background{0.0f, 0.0f, 0.0f, 1.0f};  ///< linear RGBA
};

/// Draws a scene. One may serve many scenes, targets and contexts, one render() at a time.
class Renderer {
 public:
  /// Draws everything below `root` as the camera sees it, lit by the lights below `root`, and leaves GL as it
  /// starts up, but for the viewport. Fails on more than 16 lights, on a geometry without a material, and on
  /// whatever was reported to the context: a shader that does not compile, an image too large.
  Result<void> render(GLContext& context, const Node& root, const Camera& camera, const RenderTarget& target,
                      const RenderOptions& options = {});

 private:
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

}  // namespace weft
