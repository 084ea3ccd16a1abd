#pragma once

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <optional>

namespace weft {

/// A perspective or orthographic view, looking along -Z of its own frame as in glTF. GL clip space.
///
/// Places are doubles, since a picture far from the world's origin has to be as steady as one near
/// it.
struct Camera {
  glm::dmat4 view{1.0};              ///< world to camera
  float verticalFieldOfView = 0.7f;  ///< radians
  float orthographicHeight = 0.0f;   ///< above 0: an orthographic view, so high in world units
  float nearPlane = 0.01f;
  float farPlane = 100.0f;
  /// A projection of the application's own, instead of what the numbers above say.
  std::optional<glm::dmat4> ownProjection{};

  glm::dmat4 projection(float aspect) const;
  glm::dvec3 position() const;
  /// Where it is seen from, homogeneous: position() with w = 1; of an orthographic view the unit
  /// direction towards the viewer with w = 0.
  glm::dvec4 eye() const;

  /// Whether all rays are parallel.
  bool isOrthographic() const;

  static Camera lookAt(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up = {0, 1, 0});
};

}  // namespace weft
