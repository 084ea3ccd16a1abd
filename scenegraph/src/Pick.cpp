#include "weft/scenegraph/Pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "FlatScene.h"

namespace weft {

namespace {

struct TriangleHit {
  glm::dvec3 offset{0.0};           ///< from the ray's origin
  std::array<double, 3> weights{};  ///< of the corners
};

/// The corners are relative to the ray's origin. The sign of the volume that an edge spans with the
/// ray turns exactly when the edge does, so that one of two neighbours is met.
std::optional<TriangleHit> meet(const glm::dvec3& direction, const std::array<glm::dvec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const std::array<double, 3> volumes{glm::dot(direction, glm::cross(b, c)),
                                      glm::dot(direction, glm::cross(c, a)),
                                      glm::dot(direction, glm::cross(a, b))};
  const auto [least, largest] = std::minmax_element(volumes.begin(), volumes.end());
  const double sum = volumes[0] + volumes[1] + volumes[2];
  if ((*least < 0.0 && *largest > 0.0) || sum == 0.0 || !std::isfinite(sum)) return std::nullopt;
  TriangleHit hit{.weights = {volumes[0] / sum, volumes[1] / sum, volumes[2] / sum}};
  hit.offset = hit.weights[0] * a + hit.weights[1] * b + hit.weights[2] * c;
  if (glm::dot(hit.offset, direction) < 0.0) return std::nullopt;
  return hit;
}

/// The nearest hit so far.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  TriangleHit hit;
  const FlatObject* object = nullptr;
  std::size_t triangle = 0;
};

/// `center`: of the object's box.
void findNearest(const FlatObject& object, const glm::dvec3& center, const Ray& ray, Nearest& nearest) {
  const auto& geometry = static_cast<const Geometry&>(object.node->core());
  const Mesh& mesh = *geometry.mesh();
  if (mesh.topology != Topology::Triangles) return;
  const auto& rows = object.model.rows;
  const glm::dmat3 linear = glm::transpose(glm::dmat3(rows[0], rows[1], rows[2]));
  const glm::dvec3 middle = geometry.bounds().center(), offset = center - ray.origin;
  std::vector<glm::dvec3> places;
  places.reserve(mesh.positions.size());
  for (const glm::vec3 position : mesh.positions)
    places.push_back(linear * (glm::dvec3(position) - middle) + offset);
  const auto place = [&](std::size_t i) { return places[mesh.indices[i]]; };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto hit = meet(ray.direction, {place(i), place(i + 1), place(i + 2)});
    if (!hit || !(glm::length(hit->offset) < nearest.distance)) continue;
    nearest = {glm::length(hit->offset), *hit, &object, i / 3};
  }
}

glm::vec2 texcoordOf(const Mesh& mesh, const Nearest& nearest) {
  glm::dvec2 texcoord(0.0);
  for (std::size_t i = 0; i < 3; ++i)
    if (!mesh.texcoords.empty())
      texcoord += nearest.hit.weights[i] * glm::dvec2(mesh.texcoords[mesh.indices[3 * nearest.triangle + i]]);
  return texcoord;
}

std::vector<const Node*> pathTo(const Node& root, const Node* node) {
  std::vector<const Node*> path{node};
  while (path.back() != &root) path.push_back(path.back()->parent());
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

std::optional<Hit> pick(const Node& root, const Ray& ray) {
  FlatScene& scene = FlatScene::of(root);
  const auto lock = scene.look();
  std::vector<std::uint32_t> met;
  scene.boxes().findMet(ray, met);
  Nearest nearest;
  for (const std::uint32_t number : met) {
    const FlatObject& object = scene.objects()[number];
    if (scene.shows(object.level, ray.origin))
      findNearest(object, scene.boxes().center(number), ray, nearest);
  }
  if (!nearest.object) return std::nullopt;
  return Hit{.path = pathTo(root, nearest.object->node),
             .distance = nearest.distance,
             .position = ray.origin + nearest.hit.offset,
             .texcoord = texcoordOf(*scene.meshes()[nearest.object->mesh].mesh, nearest),
             .triangle = nearest.triangle};
}

}  // namespace weft
