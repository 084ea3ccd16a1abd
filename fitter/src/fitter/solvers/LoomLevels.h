#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// The products of terms, `[pair][component]`, summed over pairs as a display weighs them:
/// `squaredWeights` are those of some texels, `[texel][pair]`. `[component][component]`.
std::vector<double> weightedGram(std::span<const float> terms, std::size_t components,
                                 std::span<const float> squaredWeights);

/// All levels down to one texel, whose shared numbers are a base colour, then weights.
///
/// Box filtered weights give box filtered luminance; the base colour of a coarser texel is the one
/// that comes closest to the box filtered colours of its finest ones. From the third level on there
/// are fewer components, 32, 16, then 8: the weights of the others are 0. Levels are made from
/// unrounded numbers, then rounded.
std::vector<FieldLevel> loomLevels(FieldLevel finest, std::span<const double> gram,
                                   const std::function<float(float)>& roundWeight,
                                   const std::function<glm::vec3(glm::vec3)>& roundColor);

}  // namespace weft
