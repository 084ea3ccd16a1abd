#include "weft/scenegraph/Bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

#include "weft/core/Contract.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Switch.h"
#include "weft/scenegraph/Traversal.h"

namespace weft {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double distanceToSegment(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double squared = glm::dot(along, along);
  const double place = squared > 0.0 ? std::clamp(-glm::dot(a, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(a + place * along);
}

/// From the origin to the plane of a triangle, if that is where the triangle is nearest; infinity
/// otherwise.
double distanceToInside(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const bool above = glm::dot(glm::cross(a, b), normal) > 0.0 && glm::dot(glm::cross(b, c), normal) > 0.0 &&
                     glm::dot(glm::cross(c, a), normal) > 0.0;
  return above ? std::abs(glm::dot(normal, a)) / glm::length(normal) : kInfinity;
}

double distanceToMesh(const Mesh& mesh, const glm::dmat4& fromPoint) {
  const std::size_t count = verticesPer(mesh.topology);
  double least = kInfinity;
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i + count <= mesh.indices.size(); i += count) {
    for (std::size_t k = 0; k < count; ++k)
      corners[k] = glm::dvec3(fromPoint * glm::dvec4(mesh.positions[mesh.indices[i + k]], 1.0));
    for (std::size_t k = 0; k < count; ++k)
      least = std::min(least, distanceToSegment(corners[k], corners[(k + 1) % count]));
    if (count == 3) least = std::min(least, distanceToInside(corners[0], corners[1], corners[2]));
  }
  return least;
}

/// Whether what starts at an index can be seen: a triangle that collapsed has no area.
bool isSeen(const Mesh& mesh, std::size_t first) {
  if (mesh.topology != Topology::Triangles) return true;
  std::array<glm::dvec3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.positions[mesh.indices[first + k]];
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]) != glm::dvec3(0.0);
}

/// Shows a function the vertices of all that can be seen, each once.
template <class See>
void forEachUsedVertex(const Mesh& mesh, See see) {
  std::vector<bool> used(mesh.positions.size());
  const std::size_t count = verticesPer(mesh.topology);
  for (std::size_t i = 0; i + count <= mesh.indices.size(); i += count) {
    const std::span corners = std::span(mesh.indices).subspan(i, count);
    // What is no mesh is told when it is drawn.
    const bool exist = std::ranges::all_of(corners, [&](std::uint32_t k) { return k < used.size(); });
    if (!exist || !isSeen(mesh, i)) continue;
    for (const std::uint32_t corner : corners) used[corner] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) see(glm::dvec3(mesh.positions[i]));
}

bool isHiddenBySwitch(const Node& node) {
  if (!node.parent()) return false;
  const auto* above = dynamic_cast<const Switch*>(&node.parent()->core());
  if (!above || above->choice() == Switch::kAll) return false;
  const auto& brothers = node.parent()->children();
  const auto choice = static_cast<std::size_t>(above->choice());
  return above->choice() < 0 || choice >= brothers.size() || brothers[choice].get() != &node;
}

/// Whether a matrix leaves triangles an area, and lines and points a place of their own.
bool leavesSomething(const glm::dmat3& matrix, Topology topology) {
  const auto isZero = [](const glm::dvec3& v) { return v == glm::dvec3(0.0); };
  if (topology != Topology::Triangles) return !(isZero(matrix[0]) && isZero(matrix[1]) && isZero(matrix[2]));
  return !(isZero(glm::cross(matrix[0], matrix[1])) && isZero(glm::cross(matrix[1], matrix[2])) &&
           isZero(glm::cross(matrix[2], matrix[0])));
}

template <class See>
void forEachSeenMesh(const Node& root, See see) {
  traverse(root, [&](const Node& node, const glm::dmat4& toWorld) {
    if (&node != &root && isHiddenBySwitch(node)) return Visit::Skip;
    const auto* geometry = dynamic_cast<const Geometry*>(&node.core());
    if (geometry && leavesSomething(glm::dmat3(toWorld), geometry->mesh()->topology))
      see(*geometry->mesh(), toWorld);
    return Visit::Continue;
  });
}

template <class See>
void forEachSeenVertex(const Node& root, See see) {
  forEachSeenMesh(root, [&](const Mesh& mesh, const glm::dmat4& toWorld) {
    forEachUsedVertex(
        mesh, [&](const glm::dvec3& position) { see(glm::dvec3(toWorld * glm::dvec4(position, 1.0))); });
  });
}

}  // namespace

double Bounds::radius() const {
  return empty() ? 0.0 : 0.5 * glm::length(maximum - minimum);
}

void Bounds::include(glm::dvec3 point) {
  minimum = glm::min(minimum, point);
  maximum = glm::max(maximum, point);
}

Bounds boundsOf(const Mesh& mesh) {
  Bounds bounds;
  forEachUsedVertex(mesh, [&](const glm::dvec3& vertex) { bounds.include(vertex); });
  return bounds;
}

Bounds boundsOf(const Node& root) {
  Bounds bounds;
  forEachSeenVertex(root, [&](const glm::dvec3& vertex) { bounds.include(vertex); });
  return bounds;
}

double distanceTo(const Node& root, const glm::dvec3& point) {
  const glm::dmat4 fromPoint = glm::translate(glm::dmat4(1.0), -point);
  double least = kInfinity;
  forEachSeenMesh(root, [&](const Mesh& mesh, const glm::dmat4& toWorld) {
    least = std::min(least, distanceToMesh(mesh, fromPoint * toWorld));
  });
  return least;
}

Camera frame(const Node& root, glm::vec3 from, float aspect, float verticalFieldOfView) {
  WEFT_EXPECT(glm::length(from) > 0.0f && aspect > 0.0f, "a picture has a direction and an area");
  const glm::dvec3 back = glm::normalize(glm::dvec3(from));
  const glm::dvec3 up = std::abs(back.y) > 0.999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  const glm::dmat3 toCamera = glm::transpose(glm::dmat3(right, glm::cross(back, right), back));
  constexpr double margin = 1.06;
  const double tangentY = std::tan(0.5 * double{verticalFieldOfView}) / margin;
  const glm::dvec2 tangent(double{aspect} * tangentY, tangentY);

  // A vertex p (camera axes, from the first vertex) is inside for an eye e where |p.x - e.x| <=
  // tangent.x (e.z
  // - p.z), and likewise for y: two planes a side, of which the outermost vertices decide.
  std::optional<glm::dvec3> origin;
  glm::dvec2 high(-kInfinity), low(-kInfinity);
  double nearest = -kInfinity, farthest = kInfinity;
  forEachSeenVertex(root, [&](const glm::dvec3& vertex) {
    if (!origin) origin = vertex;
    const glm::dvec3 p = toCamera * (vertex - *origin);
    high = glm::max(high, tangent * p.z + glm::dvec2(p));
    low = glm::max(low, tangent * p.z - glm::dvec2(p));
    nearest = std::max(nearest, p.z);
    farthest = std::min(farthest, p.z);
  });
  WEFT_EXPECT(origin, "there is nothing to frame");
  const glm::dvec2 distances = 0.5 * (high + low) / tangent;
  const double size = std::max({nearest - farthest, distances.x - farthest, distances.y - farthest});
  // At least a little in front of what is nearest, which the planes alone do not ask of a line; a
  // point is as large from anywhere.
  const double gap = size > 0.0 ? 0.01 * size : 1.0;
  const double eye = std::max({distances.x, distances.y, nearest + gap});
  const glm::dvec3 position = *origin + glm::dvec3(0.5 * (high - low), eye) * toCamera;

  Camera camera;
  camera.view = glm::dmat4(toCamera);
  camera.view[3] = glm::dvec4(-(toCamera * position), 1.0);
  camera.verticalFieldOfView = verticalFieldOfView;
  camera.nearPlane = static_cast<float>(0.9 * (eye - nearest));
  camera.farPlane = static_cast<float>(1.1 * (eye - farthest));
  return camera;
}

}  // namespace weft
