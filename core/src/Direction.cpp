#include "weft/core/Direction.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "weft/core/Contract.h"

namespace weft {

glm::vec3 directionFromDegrees(double theta, double phi) {
  const double t = glm::radians(theta);
  const double p = glm::radians(phi);
  return glm::vec3(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
}

glm::dvec2 degreesFromDirection(glm::vec3 direction) {
  const double theta = glm::degrees(std::acos(std::clamp(static_cast<double>(direction.z), -1.0, 1.0)));
  if (direction.x == 0.0f && direction.y == 0.0f) return {theta, 0.0};
  const double phi =
      glm::degrees(std::atan2(static_cast<double>(direction.y), static_cast<double>(direction.x)));
  return {theta, phi < 0.0 ? phi + 360.0 : phi};
}

std::size_t nearestDirection(std::span<const glm::vec3> directions, glm::vec3 wanted) {
  WEFT_EXPECT(!directions.empty(), "there are directions");
  return static_cast<std::size_t>(
      std::ranges::max_element(directions, {},
                               [&](glm::vec3 direction) { return glm::dot(direction, wanted); }) -
      directions.begin());
}

glm::vec2 parabolicFromDirection(glm::vec3 direction) {
  return glm::vec2(direction.x, direction.y) / (1.0f + direction.z);
}

glm::vec3 directionFromParabolic(glm::vec2 p) {
  const float squared = glm::dot(p, p);
  return glm::vec3(2.0f * p, 1.0f - squared) / (1.0f + squared);
}

}  // namespace weft
