#include "weft/scenegraph/Camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace weft {

glm::mat4 Camera::projection(float aspect) const {
  return glm::perspective(verticalFieldOfView, aspect, nearPlane, farPlane);
}

glm::vec3 Camera::position() const {
  return glm::vec3(glm::inverse(view)[3]);
}

Camera Camera::lookAt(glm::vec3 eye, glm::vec3 target, glm::vec3 up) {
  Camera camera;
  camera.view = glm::lookAt(eye, target, up);
  return camera;
}

}  // namespace weft
