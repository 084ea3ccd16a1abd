#pragma once

#include <glm/vec3.hpp>
#include <limits>

#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Node.h"

namespace weft {

/// An axis-aligned box around points; empty until the first is included.
struct Bounds {
  glm::vec3 minimum{std::numeric_limits<float>::infinity()};
  glm::vec3 maximum{-std::numeric_limits<float>::infinity()};

  bool empty() const { return !(minimum.x <= maximum.x); }
  glm::vec3 center() const { return 0.5f * (minimum + maximum); }
  /// Half of the diagonal: the radius of a sphere around the box.
  float radius() const;
  void include(glm::vec3 point);
};

/// Around every vertex of every Geometry below `root`, in the coordinates in which `root` stands.
Bounds boundsOf(const Node& root);

/// The nearest camera that sees every vertex below `root`, with a small margin, from the direction `from`
/// (need not be unit), with near and far planes that enclose them. There must be something to see. `aspect`:
/// width / height of the picture.
Camera frame(const Node& root, glm::vec3 from, float aspect, float verticalFieldOfView = 0.5f);

}  // namespace weft
