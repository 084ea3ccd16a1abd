#include "weft/scenegraph/Camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace weft {

glm::dmat4 Camera::projection(float aspect) const {
  if (ownProjection) return *ownProjection;
  if (orthographicHeight > 0.0f) {
    const double y = 0.5 * double{orthographicHeight}, x = double{aspect} * y;
    return glm::ortho(-x, x, -y, y, double{nearPlane}, double{farPlane});
  }
  return glm::perspective(double{verticalFieldOfView}, double{aspect}, double{nearPlane}, double{farPlane});
}

glm::dvec3 Camera::position() const {
  return glm::dvec3(glm::inverse(view)[3]);
}

glm::dvec4 Camera::eye() const {
  if (isOrthographic()) return glm::dvec4(glm::normalize(glm::dvec3(glm::inverse(view)[2])), 0.0);
  return glm::dvec4(position(), 1.0);
}

bool Camera::isOrthographic() const {
  return ownProjection ? (*ownProjection)[2][3] == 0.0 : orthographicHeight > 0.0f;
}

Camera Camera::lookAt(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up) {
  Camera camera;
  camera.view = glm::lookAt(eye, target, up);
  return camera;
}

}  // namespace weft
