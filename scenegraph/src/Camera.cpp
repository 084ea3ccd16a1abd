#include "weft/scenegraph/Camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace weft {

glm::mat4 Camera::projection(float aspect) const {
  if (ownProjection) return *ownProjection;
  if (orthographicHeight > 0.0f) {
    const float y = 0.5f * orthographicHeight, x = aspect * y;
    return glm::ortho(-x, x, -y, y, nearPlane, farPlane);
  }
  return glm::perspective(verticalFieldOfView, aspect, nearPlane, farPlane);
}

glm::vec3 Camera::position() const {
  return glm::vec3(glm::inverse(view)[3]);
}

glm::vec4 Camera::eye() const {
  if (isOrthographic()) return glm::vec4(glm::normalize(glm::vec3(glm::inverse(view)[2])), 0.0f);
  return glm::vec4(position(), 1.0f);
}

bool Camera::isOrthographic() const {
  return ownProjection ? (*ownProjection)[2][3] == 0.0f : orthographicHeight > 0.0f;
}

Camera Camera::lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up) {
  Camera camera;
  camera.view = glm::lookAt(eye, target, up);
  return camera;
}

}  // namespace weft
