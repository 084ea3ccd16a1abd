#include "weft/reflectance/SheenTable.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "TablePlace.h"

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// Lambda of Conty and Kulla's shadowing, whose logarithm they fitted between r = 0 and 1.
class SheenShadowing {
 public:
  explicit SheenShadowing(float r) {
    const float smooth = (1.0f - r) * (1.0f - r);
    a_ = glm::mix(21.5473f, 25.3245f, smooth);
    b_ = glm::mix(3.82987f, 3.32435f, smooth);
    c_ = glm::mix(0.19823f, 0.16801f, smooth);
    d_ = glm::mix(-1.97760f, -1.27393f, smooth);
    e_ = glm::mix(-4.32054f, -4.85967f, smooth);
  }

  float at(float cosine) const {
    return std::exp(cosine < 0.5f ? fitted(cosine) : 2.0f * fitted(0.5f) - fitted(1.0f - cosine));
  }

 private:
  float fitted(float x) const { return a_ / (1.0f + b_ * std::pow(x, c_)) + d_ * x + e_; }

  float a_, b_, c_, d_, e_;
};

float reflectedBySheen(float nv, float roughness) {
  constexpr int kHeights = 32, kAzimuths = 16;
  const float r = roughness * roughness;
  const SheenShadowing shadowing(r);
  const float shadowOfView = shadowing.at(nv);
  const glm::vec3 v(std::sqrt(1.0f - nv * nv), 0.0f, nv);
  float sum = 0.0f;
  for (int i = 0; i < kHeights; ++i) {
    // Denser at the horizon, where smooth sheen comes from.
    const float step = (static_cast<float>(i) + 0.5f) / kHeights, nl = step * step;
    const float across = std::sqrt(1.0f - nl * nl);
    float ring = 0.0f;
    for (int j = 0; j < kAzimuths; ++j) {
      const float phi = kPi * (static_cast<float>(j) + 0.5f) / kAzimuths;
      const glm::vec3 h = glm::normalize(v + glm::vec3(across * std::cos(phi), across * std::sin(phi), nl));
      ring += std::pow(std::max(1.0f - h.z * h.z, 0.0f), 0.5f / r);
    }
    sum += step * ring / (1.0f + shadowOfView + shadowing.at(nl));
  }
  // D V n.l, times the solid angle of a sample: 2 step / heights by 2 pi / azimuths.
  return sum * (2.0f + 1.0f / r) / (2.0f * nv * kHeights * kAzimuths);
}

}  // namespace

SheenTable::SheenTable() : image_(32, 16, {"R"}) {
  for (int y = 0; y < image_.height(); ++y)
    for (int x = 0; x < image_.width(); ++x) {
      const float nv = std::max(static_cast<float>(x) / static_cast<float>(image_.width() - 1), 5e-3f);
      const float roughness = static_cast<float>(y) / static_cast<float>(image_.height() - 1);
      image_.at(x, y, 0) = std::min(reflectedBySheen(nv, std::max(roughness, kSmoothest)), 1.0f);
    }
}

float SheenTable::at(float cosineToView, float roughness) const {
  const auto [x, right] = placeInTable(cosineToView, image_.width());
  const auto [y, down] = placeInTable(roughness, image_.height());
  return glm::mix(glm::mix(image_.at(x, y, 0), image_.at(x + 1, y, 0), right),
                  glm::mix(image_.at(x, y + 1, 0), image_.at(x + 1, y + 1, 0), right), down);
}

}  // namespace weft
