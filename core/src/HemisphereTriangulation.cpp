#include "weft/core/HemisphereTriangulation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>

#include "weft/core/Direction.h"

namespace weft {
namespace {

using Corners = std::array<int, 3>;

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

// > 0 if `p` lies inside the circle through a, b, c (counter-clockwise).
double inCircle(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 p) {
  a -= p, b -= p, c -= p;
  return glm::dot(a, a) * cross(b, c) - glm::dot(b, b) * cross(a, c) + glm::dot(c, c) * cross(a, b);
}

// Rings of equal polar angle and regular azimuths make many cocircular quadruples. A shear and
// stretch far below the measuring accuracy, the same for every input, decides them all
// consistently.
glm::dvec2 withoutTies(glm::dvec2 p) {
  return {p.x + 1e-7 * p.y + 3e-7 * p.x * p.x, p.y + 2e-7 * p.x * p.y};
}

// Bowyer and Watson's incremental insertion; quadratic, for the few hundred directions of a
// measurement.
std::vector<Corners> delaunay(const std::vector<glm::dvec2>& input) {
  std::vector<glm::dvec2> points;
  for (glm::dvec2 p : input) points.push_back(withoutTies(p));
  const int count = static_cast<int>(points.size());
  constexpr double far = 1e4;  // of a triangle around everything, removed at the end
  points.insert(points.end(), {{-3 * far, -far}, {3 * far, -far}, {0, 3 * far}});
  const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };

  std::vector<Corners> triangles{{count, count + 1, count + 2}};
  for (int i = 0; i < count; ++i) {
    std::map<std::pair<int, int>, int> directedEdges;
    std::vector<Corners> kept;
    for (const Corners& t : triangles) {
      if (inCircle(at(t[0]), at(t[1]), at(t[2]), at(i)) <= 0.0) {
        kept.push_back(t);
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) ++directedEdges[{t[k], t[(k + 1) % 3]}];
    }
    for (const auto& [edge, uses] : directedEdges)
      if (!directedEdges.contains({edge.second, edge.first})) kept.push_back({edge.first, edge.second, i});
    triangles = std::move(kept);
  }
  std::erase_if(triangles, [&](const Corners& t) { return *std::max_element(t.begin(), t.end()) >= count; });
  return triangles;
}

HemisphereTriangulation::Triangle makeTriangle(Corners corners, const std::vector<glm::dvec2>& p) {
  HemisphereTriangulation::Triangle triangle;
  triangle.corner = corners;
  glm::dmat3 m;
  for (std::size_t k = 0; k < 3; ++k)
    m[static_cast<int>(k)] = glm::dvec3(p[static_cast<std::size_t>(corners[k])], 1.0);
  const glm::dmat3 rows = glm::transpose(glm::inverse(m));
  for (int k = 0; k < 3; ++k) triangle.weightRows[static_cast<std::size_t>(k)] = glm::vec3(rows[k]);
  return triangle;
}

float weightRow(const HemisphereTriangulation::Triangle& triangle, std::size_t k, glm::vec2 p) {
  return glm::dot(triangle.weightRows[k], glm::vec3(p, 1.0f));
}

// A point outside of a hull edge slides towards the pole until the weight of the opposite corner is
// 0.
glm::vec2 slideToHull(const HemisphereTriangulation::Triangle& triangle, glm::vec2 p) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::vec3 row = triangle.weightRows[k];
    const float slope = glm::dot(glm::vec2(row), p);
    if (triangle.hullEdge[k] && slope + row.z < 0.0f && row.z > 0.0f) return p * (-row.z / slope);
  }
  return p;
}

}  // namespace

int DirectionWeights::nearest() const {
  if (weight.x >= weight.y && weight.x >= weight.z) return index[0];
  return weight.y >= weight.z ? index[1] : index[2];
}

DirectionWeights HemisphereTriangulation::Triangle::weightsAt(glm::vec2 p) const {
  p = slideToHull(*this, p);
  glm::vec3 weight;
  for (int k = 0; k < 3; ++k) weight[k] = std::max(weightRow(*this, static_cast<std::size_t>(k), p), 0.0f);
  return {corner, weight / (weight.x + weight.y + weight.z)};
}

Result<HemisphereTriangulation> HemisphereTriangulation::create(std::span<const glm::vec3> directions) {
  if (directions.empty()) return fail("there are no directions to interpolate between");
  std::vector<glm::dvec2> points;
  for (glm::vec3 direction : directions) {
    if (!(std::abs(glm::length(direction) - 1.0f) < 1e-3f) || direction.z < 0.0f)
      return fail("a measured direction is not a unit vector of the upper hemisphere");
    const glm::dvec2 p = parabolicFromDirection(direction);
    for (glm::dvec2 other : points)
      if (glm::distance(p, other) < 1e-5) return fail("a direction occurs twice");
    points.push_back(p);
  }

  HemisphereTriangulation result;
  if (points.size() == 1) {
    result.triangles_.push_back({{0, 0, 0}, {}, {glm::vec3(0, 0, 1), glm::vec3(0), glm::vec3(0)}});
    return result;
  }
  const std::vector<Corners> corners = delaunay(points);
  if (corners.empty())
    return fail("the directions lie on one line, which has no triangles", {},
                "measure views around the normal");

  std::map<std::pair<int, int>, int> directedEdges;
  for (const Corners& t : corners)
    for (std::size_t k = 0; k < 3; ++k) ++directedEdges[{t[k], t[(k + 1) % 3]}];
  for (const Corners& t : corners) {
    Triangle triangle = makeTriangle(t, points);
    for (std::size_t k = 0; k < 3; ++k)
      triangle.hullEdge[k] = !directedEdges.contains({t[(k + 2) % 3], t[(k + 1) % 3]});
    result.triangles_.push_back(triangle);
  }
  return result;
}

int HemisphereTriangulation::triangleAt(glm::vec2 p) const {
  int best = 0;
  float bestMinimum = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const glm::vec2 q = slideToHull(t, p);
    const float minimum = std::min({weightRow(t, 0, q), weightRow(t, 1, q), weightRow(t, 2, q)});
    if (minimum > 1e-6f) return static_cast<int>(i);  // it lies in this one
    if (minimum > bestMinimum) bestMinimum = minimum, best = static_cast<int>(i);
  }
  return best;
}

DirectionWeights HemisphereTriangulation::locate(glm::vec3 direction) const {
  const glm::vec2 p = parabolicAboveHorizon(direction);
  return triangles_[static_cast<std::size_t>(triangleAt(p))].weightsAt(p);
}

glm::vec2 parabolicAboveHorizon(glm::vec3 direction) {
  direction.z = std::max(direction.z, 0.0f);
  const float length = glm::length(direction);
  return length > 0.0f ? parabolicFromDirection(direction / length) : glm::vec2(0.0f);
}

}  // namespace weft
