#include "weft/reflectance/EnvironmentIntegrals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "weft/core/Direction.h"

namespace weft {

LightQuadrature LightQuadrature::create(const std::vector<glm::vec3>& lights) {
  constexpr float kLowest = 0.1f;
  std::vector<glm::vec3> used;
  std::ranges::copy_if(lights, std::back_inserter(used), [](glm::vec3 light) { return light.z >= kLowest; });
  if (used.empty()) used.emplace_back(0, 0, 1);

  // Points that are spread as n.l / pi, each counted for the node that is nearest.
  constexpr int kPoints = 16384;
  constexpr float kGoldenAngle = 2.39996323f;
  std::vector<int> counts(used.size());
  for (int i = 0; i < kPoints; ++i) {
    const float squared = (static_cast<float>(i) + 0.5f) / kPoints;
    const float radius = std::sqrt(squared), phi = kGoldenAngle * static_cast<float>(i);
    ++counts[nearestDirection(used,
                              {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1.0f - squared)})];
  }
  LightQuadrature quadrature;
  for (std::size_t i = 0; i < used.size(); ++i)
    quadrature.nodes.push_back({used[i], static_cast<float>(counts[i]) / kPoints});
  quadrature.exponent = std::clamp(static_cast<float>(used.size()) - 1.0f, 1.0f, 256.0f);
  return quadrature;
}

}  // namespace weft
