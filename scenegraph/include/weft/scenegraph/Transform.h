#pragma once

#include <glm/mat4x4.hpp>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Places everything below it: child to parent coordinates, column vectors.
class Transform : public NodeCore {
 public:
  explicit Transform(const glm::mat4& childToParent = glm::mat4(1.0f)) : matrix(childToParent) {}

  glm::mat4 matrix;
};

}  // namespace weft
