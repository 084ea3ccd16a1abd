#pragma once

#include <array>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace weft {

/// The six planes of what a projection shows, relative to the eye: a point p of the world is inside
/// where dot(plane.xyz, p - eye) + plane.w >= 0 for all.
struct Frustum {
  glm::dvec3 eye;
  std::array<glm::vec4, 6> planes;

  /// `fromEye`: from world axes around the eye to GL clip space.
  Frustum(const glm::dvec3& eyePlace, const glm::dmat4& fromEye) : eye(eyePlace) {
    const glm::dmat4 rows = glm::transpose(fromEye);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const glm::dvec4 row = rows[static_cast<int>(axis)];
      planes[2 * axis] = rows[3] + row;
      planes[2 * axis + 1] = rows[3] - row;
    }
  }
};

}  // namespace weft
