#include "FitWeights.h"

#include <algorithm>
#include <cmath>

#include "weft/core/Color.h"

namespace weft {

float displayWeight(float luminance) {
  // The slope of y^(1/2.2) is y^-0.55; 0.01 is about where a display's black begins.
  return 1.0f / std::sqrt(std::max(luminance, 0.0f) + 0.01f);
}

std::vector<float> displayWeights(std::span<const float> luminance) {
  std::vector<float> weights;
  weights.reserve(luminance.size());
  for (float value : luminance) weights.push_back(displayWeight(value));
  return weights;
}

glm::vec3 fitBaseColor(std::span<const glm::vec3> samples) {
  glm::dvec3 weighted(0.0);
  double squares = 0.0;
  for (glm::vec3 rgb : samples) {
    const double y = luminance(rgb);
    const double weight = displayWeight(static_cast<float>(y));
    weighted += weight * weight * y * glm::dvec3(rgb);
    squares += weight * weight * y * y;
  }
  return squares > 0.0 ? glm::vec3(weighted / squares) : glm::vec3(1.0f);
}

float targetLuminance(glm::vec3 sample, glm::vec3 baseColor) {
  const float linear = luminance(sample);
  if (linear <= 0.0f) return 0.0f;
  const float displayed =
      luminance(encode(Encoding::Gamma22, sample)) / luminance(encode(Encoding::Gamma22, baseColor));
  return std::sqrt(linear * decode(Encoding::Gamma22, displayed));
}

}  // namespace weft
