#include "weft/reflectance/LightMap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace weft {

glm::vec2 lightMapPlace(glm::vec3 light, int size) {
  const glm::vec2 disc = glm::vec2(light) / std::sqrt(1.0f + std::max(light.z, 0.0f));
  return (0.5f * glm::clamp(disc, -1.0f, 1.0f) + 0.5f) * static_cast<float>(size - 1);
}

LightMapTexels lightMapTexels(glm::vec3 light, int size) {
  const glm::vec2 place = lightMapPlace(light, size);
  const int last = std::max(size - 2, 0), step = size > 1 ? 1 : 0;
  const glm::ivec2 low(std::min(static_cast<int>(place.x), last), std::min(static_cast<int>(place.y), last));
  const glm::vec2 upper = place - glm::vec2(low);
  const int first = low.y * size + low.x;
  return {
      {first, first + step, first + step * size, first + step * size + step},
      {(1 - upper.x) * (1 - upper.y), upper.x * (1 - upper.y), (1 - upper.x) * upper.y, upper.x * upper.y}};
}

}  // namespace weft
