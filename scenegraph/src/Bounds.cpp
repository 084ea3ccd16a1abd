#include "weft/scenegraph/Bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

#include "weft/core/Contract.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/Traversal.h"

namespace weft {
namespace {

template <class See>
void forEachVertex(const Node& root, See see) {
  traverse(root, [&](const Node& node, const glm::mat4& toWorld) {
    if (const auto* geometry = dynamic_cast<const Geometry*>(&node.core()))
      for (const glm::vec3 position : geometry->mesh()->positions)
        see(glm::vec3(toWorld * glm::vec4(position, 1.0f)));
    return Visit::Continue;
  });
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
  forEachVertex(root, [&](glm::vec3 vertex) { bounds.include(vertex); });
  return bounds;
}

Camera frame(const Node& root, glm::vec3 from, float aspect, float verticalFieldOfView) {
  WEFT_EXPECT(glm::length(from) > 0.0f && aspect > 0.0f, "a picture has a direction and an area");
  const glm::vec3 back = glm::normalize(from);
  const glm::vec3 up = std::abs(back.y) > 0.999f ? glm::vec3(0, 0, -1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(up, back));
  const glm::mat3 toCamera = glm::transpose(glm::mat3(right, glm::cross(back, right), back));
  constexpr float margin = 1.06f;
  const float tangentY = std::tan(0.5f * verticalFieldOfView) / margin;
  const glm::vec2 tangent(aspect * tangentY, tangentY);

  // A vertex p (camera axes) is inside for an eye e where |p.x - e.x| <= tangent.x (e.z - p.z), and likewise
  // for y: two planes a side, of which the outermost vertices decide.
  constexpr float infinity = std::numeric_limits<float>::infinity();
  glm::vec2 high(-infinity), low(-infinity);
  float nearest = -infinity, farthest = infinity;
  forEachVertex(root, [&](glm::vec3 vertex) {
    const glm::vec3 p = toCamera * vertex;
    high = glm::max(high, tangent * p.z + glm::vec2(p));
    low = glm::max(low, tangent * p.z - glm::vec2(p));
    nearest = std::max(nearest, p.z);
    farthest = std::min(farthest, p.z);
  });
  WEFT_EXPECT(nearest >= farthest, "there is nothing to frame");
  const glm::vec2 distances = 0.5f * (high + low) / tangent;
  const float depth = std::max({nearest - farthest, distances.x - farthest, distances.y - farthest, 1e-3f});
  // At least a little in front of what is nearest, which the planes alone do not ask of a line.
  const float eye = std::max({distances.x, distances.y, nearest + 0.01f * depth});
  const glm::vec3 position = glm::vec3(0.5f * (high - low), eye) * toCamera;

  Camera camera = Camera::lookAt(position, position - back, up);
  camera.verticalFieldOfView = verticalFieldOfView;
  camera.nearPlane = 0.9f * (eye - nearest);
  camera.farPlane = 1.1f * (eye - farthest);
  return camera;
}

}  // namespace weft
