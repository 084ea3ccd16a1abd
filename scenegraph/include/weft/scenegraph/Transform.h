#pragma once

#include <glm/mat4x4.hpp>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Places everything below it: child to parent coordinates, column vectors, last row (0, 0, 0, 1).
class Transform : public NodeCore {
 public:
  explicit Transform(const glm::mat4& childToParent = glm::mat4(1.0f)) : matrix_(childToParent) {}

  const glm::mat4& matrix() const { return matrix_; }
  void setMatrix(const glm::mat4& childToParent) {
    matrix_ = childToParent;
    changed();
  }

 private:
  glm::mat4 matrix_;
};

}  // namespace weft
