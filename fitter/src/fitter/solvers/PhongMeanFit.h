#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "weft/reflectance/PhongMean.h"

namespace weft {

/// The mean that comes closest to values of all pairs, `[view][light]`, in the sum of squares times
/// `squaredWeights`; `factors` are what the formula is multiplied by. All are finite. Where pairs
/// do not determine it, the smallest. The exponent lies between 1 and `sharpest`.
PhongMean fitPhongMean(std::span<const glm::vec3> views, std::span<const glm::vec3> lights,
                       std::span<const double> values, std::span<const double> squaredWeights,
                       std::span<const double> factors, float sharpest);

}  // namespace weft
