#include "weft/reflectance/LayerLookup.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {
namespace {

struct CubePoint {
  int face;
  float s, t;  // 0..1
};

// The face and coordinates that GL selects for a direction (OpenGL 4.5, table 8.19).
CubePoint cubePoint(glm::vec3 d) {
  const glm::vec3 a = glm::abs(d);
  if (a.x >= a.y && a.x >= a.z)
    return {d.x > 0.0f ? 0 : 1, 0.5f * ((d.x > 0.0f ? -d.z : d.z) / a.x + 1.0f), 0.5f * (-d.y / a.x + 1.0f)};
  if (a.y >= a.z)
    return {d.y > 0.0f ? 2 : 3, 0.5f * (d.x / a.y + 1.0f), 0.5f * ((d.y > 0.0f ? d.z : -d.z) / a.y + 1.0f)};
  return {d.z > 0.0f ? 4 : 5, 0.5f * ((d.z > 0.0f ? d.x : -d.x) / a.z + 1.0f), 0.5f * (-d.y / a.z + 1.0f)};
}

// The inverse of cubePoint(), not normalised.
glm::vec3 cubeDirection(int face, float s, float t) {
  const float u = 2.0f * s - 1.0f;
  const float v = 2.0f * t - 1.0f;
  switch (face) {
    case 0:
      return {1.0f, -v, -u};
    case 1:
      return {-1.0f, -v, u};
    case 2:
      return {u, 1.0f, v};
    case 3:
      return {u, -1.0f, -v};
    case 4:
      return {u, -v, 1.0f};
    default:
      return {-u, -v, -1.0f};
  }
}

}  // namespace

LayerLookup LayerLookup::create(const HemisphereTriangulation& triangulation, int cubeSize) {
  LayerLookup lookup;
  lookup.triangleOfDirection = FloatImage(cubeSize, cubeSize, {"triangle"}, 6);
  const float step = 1.0f / static_cast<float>(cubeSize);
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < cubeSize; ++y)
      for (int x = 0; x < cubeSize; ++x) {
        const glm::vec3 direction =
            cubeDirection(face, (static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step);
        lookup.triangleOfDirection.at(x, y, 0, face) =
            static_cast<float>(triangulation.triangleAt(parabolicAboveHorizon(direction)));
      }

  const auto& triangles = triangulation.triangles();
  lookup.triangles = FloatImage(3, static_cast<int>(triangles.size()), {"R", "G", "B", "A"});
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto texel = lookup.triangles.texel(static_cast<int>(k), static_cast<int>(i));
      const glm::vec3 row = triangles[i].weightRows[k];
      const auto index = static_cast<float>(1 + triangles[i].corner[k]);
      std::ranges::copy(std::array{row.x, row.y, row.z, triangles[i].hullEdge[k] ? -index : index},
                        texel.begin());
    }
  return lookup;
}

DirectionWeights LayerLookup::locate(const HemisphereTriangulation& triangulation,
                                     glm::vec3 direction) const {
  direction.z = std::max(direction.z, 0.0f);
  const CubePoint at = cubePoint(direction);
  const auto size = static_cast<float>(triangleOfDirection.width());
  const auto texelOf = [&](float s) {
    return std::clamp(static_cast<int>(s * size), 0, triangleOfDirection.width() - 1);
  };
  const auto triangle =
      static_cast<std::size_t>(triangleOfDirection.at(texelOf(at.s), texelOf(at.t), 0, at.face));
  return triangulation.triangles()[triangle].weightsAt(parabolicAboveHorizon(direction));
}

}  // namespace weft
