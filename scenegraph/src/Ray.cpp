#include "weft/scenegraph/Ray.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace weft {

Ray Ray::through(const Camera& camera, glm::vec2 place, float aspect) {
  const glm::mat4 toWorld = glm::inverse(camera.projection(aspect) * camera.view);
  const glm::vec2 clip(2.0f * place.x - 1.0f, 1.0f - 2.0f * place.y);
  const glm::vec4 from = toWorld * glm::vec4(clip, -1.0f, 1.0f);
  const glm::vec4 to = toWorld * glm::vec4(clip, 1.0f, 1.0f);
  const glm::vec3 origin = glm::vec3(from) / from.w;
  return {origin, glm::normalize(glm::vec3(to) / to.w - origin)};
}

}  // namespace weft
