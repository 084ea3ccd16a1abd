#include "weft/scenegraph/Ray.h"

#include <glm/ext/matrix_double4x4.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace weft {

Ray Ray::through(const Camera& camera, glm::vec2 place, float aspect) {
  // Relative to the eye, from which directions are exact however far away it is.
  const glm::dmat4 toWorld = glm::inverse(camera.projection(aspect) * glm::dmat4(glm::dmat3(camera.view)));
  const glm::dvec2 clip(2.0 * double{place.x} - 1.0, 1.0 - 2.0 * double{place.y});
  const glm::dvec4 from = toWorld * glm::dvec4(clip, -1.0, 1.0);
  const glm::dvec4 to = toWorld * glm::dvec4(clip, 1.0, 1.0);
  const glm::dvec3 origin = glm::dvec3(from) / from.w;
  return {camera.position() + origin, glm::normalize(glm::dvec3(to) / to.w - origin)};
}

}  // namespace weft
