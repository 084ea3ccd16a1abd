#include "weft/scene_io/MaterialSurface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/geometric.hpp>

#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Traversal.h"

namespace weft {
namespace {

struct SurfacePoint {
  glm::dvec3 place;  ///< in the world
  glm::dvec2 texture;
  glm::dvec4 clip;
};

using Polygon = std::vector<SurfacePoint>;

SurfacePoint between(const SurfacePoint& a, const SurfacePoint& b, double t) {
  return {glm::mix(a.place, b.place, t), glm::mix(a.texture, b.texture, t), glm::mix(a.clip, b.clip, t)};
}

/// What of a convex polygon lies on the inner side of a plane of clip space.
Polygon clipped(const Polygon& polygon, const glm::dvec4& plane) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const SurfacePoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double distanceA = glm::dot(plane, a.clip), distanceB = glm::dot(plane, b.clip);
    if (distanceA >= 0.0) inside.push_back(a);
    if ((distanceA >= 0.0) != (distanceB >= 0.0))
      inside.push_back(between(a, b, distanceA / (distanceA - distanceB)));
  }
  return inside;
}

Polygon withinPicture(Polygon polygon) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      glm::dvec4 plane(0.0, 0.0, 0.0, 1.0);
      plane[axis] = side;
      // Most triangles lie wholly on one side.
      const auto isInside = [&](const SurfacePoint& point) { return glm::dot(plane, point.clip) >= 0.0; };
      if (std::ranges::none_of(polygon, isInside)) return {};
      if (!std::ranges::all_of(polygon, isInside)) polygon = clipped(polygon, plane);
    }
  return polygon;
}

void addPolygon(MaterialSurface& surface, const Polygon& polygon) {
  if (polygon.size() < 3) return;
  ++surface.triangles;
  for (const SurfacePoint& point : polygon) {
    surface.minimum = glm::min(surface.minimum, point.texture);
    surface.maximum = glm::max(surface.maximum, point.texture);
  }
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const SurfacePoint &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
    const glm::dvec2 u = b.texture - a.texture, v = c.texture - a.texture;
    surface.area += 0.5 * glm::length(glm::cross(b.place - a.place, c.place - a.place));
    surface.textureArea += 0.5 * std::abs(u.x * v.y - u.y * v.x);
  }
}

void addMesh(MaterialSurface& surface, const Mesh& mesh, const glm::dmat4& toWorld,
             const std::optional<glm::dmat4>& toClip) {
  if (mesh.topology != Topology::Triangles || mesh.texcoords.size() != mesh.positions.size()) return;
  for (std::size_t i = 0; i + 3 <= mesh.indices.size(); i += 3) {
    Polygon triangle;
    for (std::size_t k = i; k < i + 3; ++k) {
      const std::uint32_t vertex = mesh.indices[k];
      if (vertex >= mesh.positions.size()) break;  // is told when it is drawn
      const glm::dvec4 place = toWorld * glm::dvec4(mesh.positions[vertex], 1.0);
      triangle.push_back({place, mesh.texcoords[vertex], toClip ? *toClip * place : glm::dvec4(0.0)});
    }
    addPolygon(surface, toClip ? withinPicture(std::move(triangle)) : triangle);
  }
}

/// The outermost material above a node.
std::shared_ptr<const Material> materialOf(const Node& node) {
  std::shared_ptr<const Material> material;
  for (const Node* above = &node; above; above = above->parent())
    if (const auto* group = dynamic_cast<const MaterialGroup*>(&above->core()); group && group->material())
      material = group->material();
  return material;
}

}  // namespace

double MaterialSurface::unitLength() const {
  return textureArea > 0.0 ? std::sqrt(area / textureArea) : 0.0;
}

std::vector<MaterialSurface> surfacesOf(const Node& root, const std::optional<glm::dmat4>& toClip) {
  std::vector<MaterialSurface> surfaces;
  traverse(root, [&](const Node& node, const glm::dmat4& toWorld) {
    const auto* geometry = dynamic_cast<const Geometry*>(&node.core());
    const auto material = geometry ? materialOf(node) : nullptr;
    if (!material) return Visit::Continue;
    auto surface = std::ranges::find(surfaces, material, &MaterialSurface::material);
    if (surface == surfaces.end()) surface = surfaces.insert(surfaces.end(), {.material = material});
    addMesh(*surface, *geometry->mesh(), toWorld, toClip);
    return Visit::Continue;
  });
  return surfaces;
}

}  // namespace weft
