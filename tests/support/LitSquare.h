#pragma once

#include <array>

#include "GltfFormulas.h"
#include "weft/core/FloatImage.h"

namespace weft::test {

struct PlacedLight {
  glm::dvec3 place, intensity;
};

/// What lights the square of TestScene.h: from all sides, at all angles.
inline constexpr std::array<PlacedLight, 2> kLamps{
    {{{0.4, -0.7, 0.9}, {1.0, 2.0, 3.0}}, {{-0.9, 0.3, 0.2}, {0.5, 0.4, 0.3}}}};

/// What squareCamera() sees of a square of this material under the lamps, by the formulas alone.
/// `coatNormal`: in the tangent frame.
inline FloatImage expectedSquare(const PBROptions& options, int size, glm::dvec3 coatNormal = {0, 0, 1}) {
  static const SheenTable table;
  FloatImage expected(size, size, {"R", "G", "B", "A"});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::dvec3 point((x + 0.5) * 2.0 / size - 1.0, 1.0 - (y + 0.5) * 2.0 / size, 0.0);
      const glm::dvec3 v = glm::normalize(glm::dvec3(0, 0, 2) - point);
      glm::dvec3 sum = (1.0 - coatShare(options.clearcoat, coatNormal, v)) * glm::dvec3(options.emission);
      for (const PlacedLight& lamp : kLamps) {
        const glm::dvec3 offset = lamp.place - point, l = glm::normalize(offset);
        sum += lamp.intensity / glm::dot(offset, offset) * shownOfLight(options, table, v, l, coatNormal);
      }
      for (int channel = 0; channel < 3; ++channel)
        expected.at(x, y, channel) = static_cast<float>(sum[channel]);
    }
  return expected;
}

/// The largest difference, relative where values are beyond 1.
inline float worstDifference(const FloatImage& actual, const FloatImage& expected) {
  float worst = 0.0f;
  for (int y = 0; y < expected.height(); ++y)
    for (int x = 0; x < expected.width(); ++x)
      for (int channel = 0; channel < 3; ++channel) {
        const float value = expected.at(x, y, channel);
        worst = std::max(worst, std::abs(actual.at(x, y, channel) - value) / std::max(1.0f, value));
      }
  return worst;
}

}  // namespace weft::test
