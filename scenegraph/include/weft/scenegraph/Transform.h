#pragma once

#include <glm/ext/matrix_double4x4.hpp>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Places everything below it: child to parent coordinates, column vectors, last row (0, 0, 0, 1).
///
/// Matrices of floats become doubles, in which those of nested nodes are multiplied.
class Transform : public NodeCore {
 public:
  explicit Transform(const glm::dmat4& childToParent = glm::dmat4(1.0)) : matrix_(childToParent) {}

  const glm::dmat4& matrix() const { return matrix_; }
  void setMatrix(const glm::dmat4& childToParent) {
    matrix_ = childToParent;
    changed();
  }

 private:
  glm::dmat4 matrix_;
};

}  // namespace weft
