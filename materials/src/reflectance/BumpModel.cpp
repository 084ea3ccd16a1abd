#include "weft/reflectance/BumpModel.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/core/Direction.h"

namespace weft {
namespace {

// Pi times D V of GGX (shaders/ggx.glsl).
float microfacets(float alpha, glm::vec3 n, glm::vec3 h, float nl, float nv) {
  const float squared = alpha * alpha;
  const glm::vec3 across = glm::cross(n, h);
  const float nh = glm::dot(n, h);
  if (nh <= 0.0f) return 0.0f;
  const float width = glm::dot(across, across) + squared * nh * nh;
  const float shadowing = nl * std::sqrt(nv * nv * (1.0f - squared) + squared) +
                          nv * std::sqrt(nl * nl * (1.0f - squared) + squared);
  return squared / (width * width) * 0.5f / shadowing;
}

}  // namespace

std::vector<ModelType> BumpModel::types() {
  return {{"bump",
           "An ordinary bump-mapped surface: a normal, an albedo and a roughness a texel.",
           {},
           [](ModelOptions options) { return std::make_shared<const BumpModel>(std::move(options)); }}};
}

float BumpModel::evaluate(std::span<const float> shared, std::span<const float>, glm::vec3 light,
                          glm::vec3 view) const {
  const glm::vec3 n = directionFromParabolic({shared[1], shared[2]});
  const float nl = glm::dot(n, light);
  if (nl <= 0.0f) return 0.0f;
  const glm::vec3 sum = light + view;
  const glm::vec3 h = sum / std::sqrt(std::max(glm::dot(sum, sum), 1e-12f));
  const float nv = std::max(std::abs(glm::dot(n, view)), 1e-4f);
  const float away = 1.0f - std::clamp(glm::dot(view, h), 0.0f, 1.0f);
  const float reflected = 0.04f + 0.96f * away * away * away * away * away;
  return nl * ((1.0f - reflected) * shared[0] + reflected * microfacets(shared[3] * shared[3], n, h, nl, nv));
}

// The split sum, as of glTF's materials (pbr.frag), around the texel's own normal.
glm::vec3 BumpModel::underEnvironment(std::span<const float> shared, std::span<const float>, glm::vec3 view,
                                      const EnvironmentIntegrals& light) const {
  constexpr float kF0 = 0.04f;
  const glm::vec3 n = directionFromParabolic({shared[1], shared[2]});
  return (1.0f - light.glossyShare(n, view, shared[3], kF0)) * shared[0] * light.diffuse(n) +
         light.glossy(n, view, shared[3], kF0);
}

}  // namespace weft
