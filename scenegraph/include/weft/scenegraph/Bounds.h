#pragma once

#include <glm/ext/vector_double3.hpp>
#include <limits>

#include "weft/scenegraph/Camera.h"
#include "weft/scenegraph/Mesh.h"
#include "weft/scenegraph/Node.h"

namespace weft {

/// An axis-aligned box around points; empty until the first is included.
struct Bounds {
  glm::dvec3 minimum{std::numeric_limits<double>::infinity()};
  glm::dvec3 maximum{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(minimum.x <= maximum.x); }
  glm::dvec3 center() const { return 0.5 * (minimum + maximum); }
  /// Half of the diagonal: the radius of a sphere around the box.
  double radius() const;
  void include(glm::dvec3 point);
};

/// Around the vertices that the mesh's triangles, lines or points have; triangles without an area
/// do not count.
Bounds boundsOf(const Mesh& mesh);

/// Around what can be seen of the geometries below `root`, in the coordinates in which `root`
/// stands: not around what a Switch hides, nor what a scale of 0 leaves no area. All levels of a
/// LOD count.
Bounds boundsOf(const Node& root);

/// From a point to the nearest triangle, line or point of what boundsOf() encloses: how far away a
/// near plane may be. Infinity where there is nothing.
double distanceTo(const Node& root, const glm::dvec3& point);

/// The nearest camera that sees all of boundsOf()'s vertices, with a small margin, from the
/// direction `from` (need not be unit), with near and far planes that enclose them. There must be
/// something to see. `aspect`: width / height of the picture.
Camera frame(const Node& root, glm::vec3 from, float aspect, float verticalFieldOfView = 0.5f);

}  // namespace weft
