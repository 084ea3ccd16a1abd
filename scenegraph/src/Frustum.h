#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace weft {

/// The six planes of what a projection shows, in world space: a point p is inside where
/// dot(plane.xyz, p) + plane.w >= 0 for all.
struct Frustum {
  std::array<glm::vec4, 6> planes;

  /// GL clip space.
  explicit Frustum(const glm::mat4& viewProjection) {
    const glm::mat4 rows = glm::transpose(viewProjection);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const glm::vec4 row = rows[static_cast<int>(axis)];
      planes[2 * axis] = rows[3] + row;
      planes[2 * axis + 1] = rows[3] - row;
    }
  }
};

}  // namespace weft
