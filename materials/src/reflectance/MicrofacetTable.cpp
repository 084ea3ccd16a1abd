#include "weft/reflectance/MicrofacetTable.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "TablePlace.h"

namespace weft {
namespace {

constexpr float kSmoothest = 0.045f;  // as pbr.frag

float share(int i, int count) {
  return static_cast<float>(i) / static_cast<float>(count - 1);
}

/// V of GGX: Smith's height-correlated shadowing (shaders/ggx.glsl).
float shadowing(float squared, float nl, float nv) {
  return 0.5f / (nl * std::sqrt(nv * nv * (1.0f - squared) + squared) +
                 nv * std::sqrt(nl * nl * (1.0f - squared) + squared));
}

glm::vec2 reflected(float nv, float roughness) {
  constexpr int kSteps = 16;
  const float alpha = roughness * roughness;
  const glm::vec3 v(std::sqrt(1.0f - nv * nv), 0.0f, nv);
  glm::vec2 sum(0.0f);
  for (int i = 0; i < kSteps; ++i) {
    // Half directions as the microfacets' normals are distributed.
    const float u = (static_cast<float>(i) + 0.5f) / kSteps;
    const float up = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
    const float across = std::sqrt(1.0f - up * up);
    for (int j = 0; j < kSteps; ++j) {
      const float phi = std::numbers::pi_v<float> * (static_cast<float>(j) + 0.5f) / kSteps;
      const glm::vec3 h(across * std::cos(phi), across * std::sin(phi), up);
      const float vh = glm::dot(v, h);
      const float nl = 2.0f * vh * up - nv;
      if (vh <= 0.0f || nl <= 0.0f) continue;
      const float weight = 4.0f * shadowing(alpha * alpha, nl, nv) * nl * vh / up;
      const float fresnel = std::pow(1.0f - vh, 5.0f);
      sum += weight * glm::vec2(1.0f - fresnel, fresnel);
    }
  }
  return sum / static_cast<float>(kSteps * kSteps);
}

}  // namespace

MicrofacetTable::MicrofacetTable() : image_(32, 32, {"R", "G"}) {
  for (int y = 0; y < image_.height(); ++y)
    for (int x = 0; x < image_.width(); ++x) {
      const glm::vec2 sums = reflected(std::max(share(x, image_.width()), 1e-3f),
                                       std::max(share(y, image_.height()), kSmoothest));
      for (int c = 0; c < 2; ++c) image_.at(x, y, c) = sums[c];
    }
}

glm::vec2 MicrofacetTable::at(float cosineToView, float roughness) const {
  const auto [x, right] = placeInTable(cosineToView, image_.width());
  const auto [y, down] = placeInTable(roughness, image_.height());
  glm::vec2 value;
  for (int c = 0; c < 2; ++c)
    value[c] = glm::mix(glm::mix(image_.at(x, y, c), image_.at(x + 1, y, c), right),
                        glm::mix(image_.at(x, y + 1, c), image_.at(x + 1, y + 1, c), right), down);
  return value;
}

}  // namespace weft
