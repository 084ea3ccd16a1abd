#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "weft/scenegraph/Camera.h"

namespace weft {

/// A half-line from `origin` in `direction`, which need not be unit but not 0.
struct Ray {
  glm::vec3 origin{0.0f};
  glm::vec3 direction{0.0f, 0.0f, -1.0f};

  /// Through a place of the picture, from the near plane on: (0, 0) is its upper left corner, (1, 1) its
  /// lower right one. World space; `aspect`: width / height.
  static Ray through(const Camera& camera, glm::vec2 place, float aspect);
};

}  // namespace weft
