#include "OrbitCamera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

namespace weft {
namespace {

constexpr double kSteepest = 1.5533;  // 89 degrees: up stays up
constexpr double kOrbitOfDrag = 3.2;  // radians for a drag over the height of the picture
constexpr double kNearest = 1e-3;     // of the scene's radius
constexpr double kFarthestEye = 1e3;  // likewise
constexpr double kNearPlane = 1e-2;   // of the distance to what is looked at
constexpr float kSmallestFieldOfView = 0.02f;

double radiusOf(const Bounds& scene) {
  return !scene.empty() && scene.radius() > 0.0 ? scene.radius() : 1.0;
}

}  // namespace

glm::dvec3 OrbitCamera::towardsEye() const {
  return {std::cos(elevation_) * std::sin(azimuth_), std::sin(elevation_),
          std::cos(elevation_) * std::cos(azimuth_)};
}

void OrbitCamera::lookAs(const Camera& camera, const Bounds& scene) {
  const glm::dmat4 place = glm::inverse(camera.view);
  const glm::dvec3 eye(place[3]), back = glm::normalize(glm::dvec3(place[2]));
  const glm::dvec3 center = scene.empty() ? glm::dvec3(0.0) : scene.center();
  radius_ = radiusOf(scene);
  distance_ = std::clamp(glm::dot(eye - center, back), kNearest * radius_, kFarthestEye * radius_);
  target_ = eye - distance_ * back;
  elevation_ = std::clamp(std::asin(std::clamp(back.y, -1.0, 1.0)), -kSteepest, kSteepest);
  azimuth_ = std::atan2(back.x, back.z);
  orthographic_ = camera.isOrthographic();
  fieldOfView_ = std::max(camera.verticalFieldOfView, kSmallestFieldOfView);
  if (orthographic_ && camera.orthographicHeight > 0.0f)  // as wide an angle as shows the same
    fieldOfView_ = 2.0f * std::atan(0.5f * camera.orthographicHeight / static_cast<float>(distance_));
}

void OrbitCamera::frame(const Node& scene, float aspect) {
  frame(scene, aspect, towardsEye());
}

void OrbitCamera::frame(const Node& scene, float aspect, glm::dvec3 from) {
  lookAs(weft::frame(scene, from, aspect, fieldOfView_), boundsOf(scene));
}

void OrbitCamera::orbit(glm::dvec2 drag) {
  azimuth_ = std::remainder(azimuth_ - kOrbitOfDrag * drag.x, glm::two_pi<double>());
  elevation_ = std::clamp(elevation_ + kOrbitOfDrag * drag.y, -kSteepest, kSteepest);
}

void OrbitCamera::pan(glm::dvec2 drag) {
  const double height = 2.0 * distance_ * std::tan(0.5 * double{fieldOfView_});
  const glm::dvec3 back = towardsEye();
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
  target_ += height * (drag.y * glm::cross(back, right) - drag.x * right);
}

void OrbitCamera::zoom(double steps) {
  distance_ = std::clamp(distance_ * std::pow(0.9, steps), kNearest * radius_, kFarthestEye * radius_);
}

Camera OrbitCamera::camera(const Bounds& scene) const {
  const double radius = radiusOf(scene);
  const glm::dvec3 eye = target_ + distance_ * towardsEye();
  Camera camera = Camera::lookAt(eye, target_);
  camera.verticalFieldOfView = fieldOfView_;
  if (orthographic_)
    camera.orthographicHeight = static_cast<float>(2.0 * distance_ * std::tan(0.5 * double{fieldOfView_}));
  const double toCenter = scene.empty() ? distance_ : glm::distance(eye, scene.center());
  camera.nearPlane = static_cast<float>(std::max(toCenter - 1.01 * radius, kNearPlane * distance_));
  camera.farPlane = static_cast<float>(std::max(toCenter + 1.01 * radius, 2.0 * double{camera.nearPlane}));
  return camera;
}

}  // namespace weft
