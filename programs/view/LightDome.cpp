#include "LightDome.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace weft {
namespace {

constexpr double kTurnOfDrag = 3.2;  // radians for a drag over the height of the picture
constexpr double kFarthest = 2.9;    // radians from the eye's side of the dome

}  // namespace

// On a map of the dome, as the camera sees it, on which distances from the middle are angles.
glm::dvec3 LightDome::dragged(glm::dvec3 lamp, const Camera& camera, glm::dvec2 drag) const {
  const glm::dmat3 toCamera(camera.view);
  const glm::dvec3 offset = lamp - center_;
  const glm::dvec3 seen =
      toCamera * (glm::length(offset) > 0.0 ? glm::normalize(offset) : glm::dvec3(0, 0, 1));
  const glm::dvec2 across(seen.x, seen.y);
  const double length = glm::length(across);
  const glm::dvec2 direction = length > 0.0 ? across / length : glm::dvec2(0.0, 1.0);
  const glm::dvec2 place = std::atan2(length, seen.z) * direction + kTurnOfDrag * glm::dvec2(drag.x, -drag.y);
  const double far = glm::length(place), angle = std::min(far, kFarthest);
  const glm::dvec2 side = far > 0.0 ? place / far : glm::dvec2(0.0);
  const glm::dvec3 moved(std::sin(angle) * side, std::cos(angle));
  return center_ + radius_ * (glm::transpose(toCamera) * moved);
}

glm::dvec3 LightDome::firstLamp(const Camera& camera) const {
  return center_ +
         radius_ * (glm::transpose(glm::dmat3(camera.view)) * glm::normalize(glm::dvec3(-0.7, 0.8, 1.0)));
}

}  // namespace weft
