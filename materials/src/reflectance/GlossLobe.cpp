#include "weft/reflectance/GlossLobe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/core/Direction.h"

namespace weft {
namespace {

constexpr float kSmoothest = 0.1f;  // alpha; fits give none as small

}  // namespace

GlossLobe GlossLobe::from(std::span<const float> numbers) {
  return {kSteepest * glm::vec2(numbers[0], numbers[1]), std::max(numbers[2] * numbers[2], kSmoothest),
          numbers[3] * numbers[3]};
}

std::array<float, GlossLobe::kNumbers> GlossLobe::numbers() const {
  return {tilt.x / kSteepest, tilt.y / kSteepest, std::sqrt(alpha), std::sqrt(amount)};
}

GlossLobe GlossLobe::rounded() const {
  std::array<float, kNumbers> bytes = numbers();
  for (float& number : bytes) number = std::round(127.0f * std::clamp(number, -1.0f, 1.0f)) / 127.0f;
  return from(bytes);
}

glm::vec3 GlossLobe::normal() const {
  return directionFromParabolic(tilt);
}

float GlossLobe::evaluate(glm::vec3 light, glm::vec3 view) const {
  if (amount == 0.0f) return 0.0f;
  const glm::vec3 n = normal(), sum = light + view;
  const glm::vec3 h = sum / std::sqrt(std::max(glm::dot(sum, sum), 1e-12f));
  const float nh = glm::dot(n, h);
  if (nh <= 0.0f) return 0.0f;
  const glm::vec3 across = glm::cross(n, h);
  const float squared = alpha * alpha;
  const float width = glm::dot(across, across) + squared * nh * nh;
  const float nl = light.z, nv = std::max(view.z, 1e-4f);
  const float shadowing = nl * std::sqrt(nv * nv * (1.0f - squared) + squared) +
                          nv * std::sqrt(nl * nl * (1.0f - squared) + squared);
  return amount * squared / (width * width) * 0.5f / shadowing;
}

}  // namespace weft
