#pragma once

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>

#include "weft/scenegraph/Camera.h"

namespace weft {

/// Where the lamps of a viewer stand: on a sphere around the scene.
class LightDome {
 public:
  LightDome(glm::dvec3 center, double radius) : center_(center), radius_(radius) {}

  /// A lamp, moved over the dome as a drag says that is seen from the camera, in heights of the
  /// picture, x to the right, y down. It is put onto the dome, and never quite behind the scene.
  glm::dvec3 dragged(glm::dvec3 lamp, const Camera& camera, glm::dvec2 drag) const;
  /// Above left of the camera.
  glm::dvec3 firstLamp(const Camera& camera) const;

 private:
  glm::dvec3 center_;
  double radius_;
};

}  // namespace weft
