#pragma once

#include <glm/ext/vector_int2.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "weft/chunks/GLName.h"
#include "weft/core/Result.h"
#include "weft/core/ToneMapping.h"
#include "weft/scenegraph/PassiveWindow.h"

namespace weft {

struct DeletePipeline {
  void operator()(GLuint name) const { glDeleteProgramPipelines(1, &name); }
};

/// A picture of a scene that is kept while a viewer draws over it, in linear half floats, and shown
/// as displays want it. Made, used and destroyed with one GL context current.
class ScenePicture {
 public:
  /// Fails where GL cannot compile what shows it.
  static Result<std::unique_ptr<ScenePicture>> create();

  /// Draws anew, waiting for GL's end. Both sides are divided by `divisor`. Fails as
  /// PassiveWindow::render() does, and where there is no memory.
  Result<void> draw(PassiveWindow& weft, const Node& root, const Camera& camera, glm::ivec2 size,
                    int divisor);
  /// What is drawn where nothing is: linear RGBA.
  static glm::vec4 background();
  /// Fills the window; `size` is its framebuffer's.
  void show(glm::ivec2 size, float stops, ToneCurve curve) const;

 private:
  ScenePicture() = default;
  Result<void> makeTarget(glm::ivec2 size);

  glm::ivec2 size_{0};
  glm::ivec2 drawn_{0};  ///< part of it, from the lower left
  GLTexture color_;
  GLTexture depth_;
  GLFramebuffer framebuffer_;
  GLVertexArray noVertices_;
  GLProgram vertex_;
  GLProgram fragment_;
  GLName<DeletePipeline> pipeline_;
};

}  // namespace weft
