#include "weft/reflectance/PhongMean.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {

float PhongMean::value(glm::vec3 light, glm::vec3 view) const {
  const glm::vec3 half = light + view;
  const float cosine = std::max(half.z, 0.0f) / std::max(glm::length(half), 1e-6f);
  return ambient + diffuse * light.z + specular * std::pow(cosine, exponent);
}

}  // namespace weft
