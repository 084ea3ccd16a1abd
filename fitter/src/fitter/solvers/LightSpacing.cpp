#include "solvers/LightSpacing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {

float sharpestExponent(std::span<const glm::vec3> lights) {
  float smallestCosine = 1.0f;  // of the gap between a light and its nearest neighbour
  for (std::size_t i = 0; i < lights.size(); ++i) {
    float nearest = -1.0f;
    for (std::size_t j = 0; j < lights.size(); ++j)
      if (j != i) nearest = std::max(nearest, glm::dot(lights[i], lights[j]));
    smallestCosine = std::min(smallestCosine, nearest);
  }
  const float gap = std::acos(std::clamp(smallestCosine, -1.0f, 1.0f));
  // Of one light alone the gap is the whole sphere, whose half's cosine may round to below 0.
  const float cosine = std::max(std::cos(0.5f * gap), 1e-6f);
  return std::clamp(std::log(0.5f) / std::log(cosine), 2.0f, 1000.0f);
}

}  // namespace weft
