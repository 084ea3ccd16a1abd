#include "weft/reflectance/CosineLobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kSmoothest = 0.045f;  // as pbr.frag
constexpr float kFarthestShift = 30.0f;

float share(int i, int count) {
  return static_cast<float>(i) / static_cast<float>(count - 1);
}

/// Bilinear, as GL does it with the first and last value in the middle of a texel.
glm::vec3 lookUp(const FloatImage& table, float x, float y) {
  const auto place = [](float share, int size) {
    return std::clamp(share, 0.0f, 1.0f) * static_cast<float>(size - 1);
  };
  const float column = place(x, table.width()), row = place(y, table.height());
  const int x0 = std::min(static_cast<int>(column), table.width() - 2);
  const int y0 = std::min(static_cast<int>(row), table.height() - 2);
  const float right = column - static_cast<float>(x0), down = row - static_cast<float>(y0);
  glm::vec3 value(0.0f);
  for (int c = 0; c < table.channelCount(); ++c)
    value[c] = glm::mix(glm::mix(table.at(x0, y0, c), table.at(x0 + 1, y0, c), right),
                        glm::mix(table.at(x0, y0 + 1, c), table.at(x0 + 1, y0 + 1, c), right), down);
  return value;
}

/// Amount, shift and log2 of the exponent, by midpoints in what the lobe itself distributes evenly.
glm::vec3 momentsOf(float exponent, float cosine) {
  constexpr int kSteps = 64;
  const float sine = std::sqrt(1.0f - cosine * cosine);
  glm::dvec3 sum(0.0);  // of n.l, and of that times l along the normal's part across t, and along t
  for (int i = 0; i < kSteps; ++i) {
    const float up = std::pow((static_cast<float>(i) + 0.5f) / kSteps, 1.0f / (exponent + 1.0f));
    const float across = std::sqrt(1.0f - up * up);
    for (int j = 0; j < kSteps; ++j) {
      const float x = across * std::cos(kPi * (static_cast<float>(j) + 0.5f) / kSteps);
      const float facing = sine * x + cosine * up;
      if (facing > 0.0f) sum += static_cast<double>(facing) * glm::dvec3(1.0, x, up);
    }
  }
  if (sum.x <= 0.0) return {0.0f, 0.0f, std::log2(exponent)};
  const double mean = std::hypot(sum.y, sum.z) / sum.x;  // (n + 1) / (n + 2) of a lobe of exponent n
  const double newExponent =
      std::clamp(1.0 / (1.0 - mean) - 2.0, 1.0, static_cast<double>(CosineLobeTable::kLargestExponent));
  return {static_cast<float>(sum.x / (kSteps * kSteps)),
          std::min(static_cast<float>(sum.y / (sum.z * sine)), kFarthestShift),
          static_cast<float>(std::log2(newExponent))};
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
      const float phi = kPi * (static_cast<float>(j) + 0.5f) / kSteps;
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

CosineLobeTable::CosineLobeTable() : image_(64, 25, {"R", "G", "B"}) {
  for (int y = 0; y < image_.height(); ++y)
    for (int x = 0; x < image_.width(); ++x) {
      // Not quite -1 and 1, where the normal has no part across t.
      const float cosine = 0.9995f * (2.0f * share(x, image_.width()) - 1.0f);
      const glm::vec3 moments = momentsOf(std::pow(kLargestExponent, share(y, image_.height())), cosine);
      for (int c = 0; c < 3; ++c) image_.at(x, y, c) = moments[c];
    }
}

CosineLobe CosineLobeTable::at(glm::vec3 t, float exponent, glm::vec3 normal) const {
  const float cosine = glm::dot(t, normal);
  const glm::vec3 found =
      lookUp(image_, 0.5f * cosine + 0.5f, std::log2(exponent) / std::log2(kLargestExponent));
  return {2.0f / (exponent + 1.0f) * found.x, glm::normalize(t + found.y * (normal - cosine * t)),
          std::exp2(found.z)};
}

MicrofacetTable::MicrofacetTable() : image_(32, 32, {"R", "G"}) {
  for (int y = 0; y < image_.height(); ++y)
    for (int x = 0; x < image_.width(); ++x) {
      const glm::vec2 sums = reflected(std::max(share(x, image_.width()), 1e-3f),
                                       std::max(share(y, image_.height()), kSmoothest));
      for (int c = 0; c < 2; ++c) image_.at(x, y, c) = sums[c];
    }
}

glm::vec2 MicrofacetTable::at(float cosineToView, float roughness) const {
  return glm::vec2(lookUp(image_, cosineToView, roughness));
}

}  // namespace weft
