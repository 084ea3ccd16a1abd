#pragma once

#include <glm/ext/vector_double3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "weft/scenegraph/Node.h"
#include "weft/scenegraph/Ray.h"

namespace weft {

/// Where a ray meets a triangle.
struct Hit {
  std::vector<const Node*> path;  ///< from the root down to the node of the geometry
  double distance = 0.0;          ///< from the ray's origin, in the root's units
  glm::dvec3 position{0.0};       ///< in the coordinates in which the root stands
  glm::vec2 texcoord{0.0f};       ///< of Mesh::texcoords, interpolated
  std::size_t triangle = 0;       ///< its number in the mesh
};

/// The nearest triangle of the scene that the ray meets, from either side; none where it meets
/// nothing.
///
/// Sees what is drawn: the shown children of Switch nodes, and of LOD nodes those for an eye at the
/// ray's origin. Exact between neighbours: a ray cannot slip through an edge that two triangles
/// share. Lines and points are not met. As RenderAction::render(), it may run on several threads,
/// but not while the tree is changed.
std::optional<Hit> pick(const Node& root, const Ray& ray);

}  // namespace weft
