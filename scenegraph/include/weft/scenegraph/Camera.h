#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace weft {

/// A perspective view, looking along -Z of its own frame as in glTF. GL clip space.
struct Camera {
  glm::mat4 view{1.0f};              ///< world to camera
  float verticalFieldOfView = 0.7f;  ///< radians
  float nearPlane = 0.01f;
  float farPlane = 100.0f;

  glm::mat4 projection(float aspect) const;
  glm::vec3 position() const;

  static Camera lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up = {0, 1, 0});
};

}  // namespace weft
