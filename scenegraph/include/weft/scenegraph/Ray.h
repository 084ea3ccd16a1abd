#pragma once

#include <glm/ext/vector_double3.hpp>
#include <glm/vec2.hpp>

#include "weft/scenegraph/Camera.h"

namespace weft {

/// A half-line from `origin` in `direction`, which need not be unit but not 0.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};

  /// Through a place of the picture, from the near plane on: (0, 0) is its upper left corner, (1,
  /// 1) its lower right one. World space; `aspect`: width / height.
  static Ray through(const Camera& camera, glm::vec2 place, float aspect);
};

}  // namespace weft
