#include "weft/scenegraph/Bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "weft/core/Contract.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

void includeBelow(const Node& node, glm::mat4 toWorld, Bounds& bounds) {
  if (const auto* transform = dynamic_cast<const Transform*>(&node.core())) toWorld *= transform->matrix;
  if (const auto* geometry = dynamic_cast<const Geometry*>(&node.core()))
    for (const glm::vec3 position : geometry->mesh()->positions)
      bounds.include(glm::vec3(toWorld * glm::vec4(position, 1.0f)));
  for (const auto& child : node.children()) includeBelow(*child, toWorld, bounds);
}

}  // namespace

float Bounds::radius() const {
  return empty() ? 0.0f : 0.5f * glm::length(maximum - minimum);
}

void Bounds::include(glm::vec3 point) {
  minimum = glm::min(minimum, point);
  maximum = glm::max(maximum, point);
}

Bounds boundsOf(const Node& root) {
  Bounds bounds;
  includeBelow(root, glm::mat4(1.0f), bounds);
  return bounds;
}

Camera frame(const Bounds& bounds, glm::vec3 from, float aspect, float verticalFieldOfView) {
  WEFT_EXPECT(!bounds.empty() && glm::length(from) > 0.0f && aspect > 0.0f, "there is nothing to frame");
  const glm::vec3 direction = glm::normalize(from);
  const glm::vec3 up = std::abs(direction.y) > 0.999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(up, direction));
  const glm::vec3 above = glm::cross(direction, right);
  const float tangentY = std::tan(0.5f * verticalFieldOfView);
  const float tangentX = aspect * tangentY;

  // The nearest eye on the line from the centre from which every corner of the box is inside the picture.
  const float radius = std::max(bounds.radius(), 1e-6f);
  float distance = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 offset = glm::mix(bounds.minimum, bounds.maximum,
                                      glm::vec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1)) -
                             bounds.center();
    const float sideways =
        std::max(std::abs(glm::dot(offset, right)) / tangentX, std::abs(glm::dot(offset, above)) / tangentY);
    distance = std::max(distance, sideways + glm::dot(offset, direction));
  }
  distance = std::max(1.05f * distance, 1e-3f * radius);

  Camera camera = Camera::lookAt(bounds.center() + distance * direction, bounds.center(), up);
  camera.verticalFieldOfView = verticalFieldOfView;
  camera.nearPlane = std::max(distance - 1.01f * radius, 0.01f * distance);
  camera.farPlane = distance + 1.01f * radius;
  return camera;
}

}  // namespace weft
