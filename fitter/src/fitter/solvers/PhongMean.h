#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace weft {

/// ka + kd l.z + ks h.z^exponent, h between light and view ([Ma 2005] eq. 5).
struct PhongMean {
  float ambient = 0.0f;
  float diffuse = 0.0f;
  float specular = 0.0f;
  float exponent = 1.0f;
};

float valueOf(const PhongMean& mean, glm::vec3 light, glm::vec3 view);

/// The one that comes closest to values of all pairs, `[view][light]`, in the sum of squares times
/// `squaredWeights`; `factors` are what the formula is multiplied by. All are finite. Where pairs
/// do not determine it, the smallest. The exponent lies between 1 and `sharpest`.
PhongMean fitPhongMean(std::span<const glm::vec3> views, std::span<const glm::vec3> lights,
                       std::span<const double> values, std::span<const double> squaredWeights,
                       std::span<const double> factors, float sharpest);

}  // namespace weft
