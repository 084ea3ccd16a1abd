#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace weft {

/// A perspective or orthographic view, looking along -Z of its own frame as in glTF. GL clip space.
struct Camera {
  glm::mat4 view{1.0f};              ///< world to camera
  float verticalFieldOfView = 0.7f;  ///< radians
  float orthographicHeight = 0.0f;   ///< above 0: an orthographic view, so high in world units
  float nearPlane = 0.01f;
  float farPlane = 100.0f;
  /// A projection of the application's own, instead of what the numbers above say.
  std::optional<glm::mat4> ownProjection{};

  glm::mat4 projection(float aspect) const;
  glm::vec3 position() const;
  /// Where it is seen from, homogeneous: position() with w = 1; of an orthographic view the unit direction
  /// towards the viewer with w = 0.
  glm::vec4 eye() const;

  /// Whether all rays are parallel.
  bool isOrthographic() const;

  static Camera lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up = {0, 1, 0});
};

}  // namespace weft
