#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/core/Color.h"

namespace weft {

/// What two weights and the hue's four numbers of a pair (two of red, two of blue) add to a colour,
/// whose luminance stays.
inline glm::vec3 hueOf(const float* numbers, std::span<const float> weights) {
  const float red = weights[0] * numbers[0] + weights[1] * numbers[1];
  const float blue = weights[0] * numbers[2] + weights[1] * numbers[3];
  const float green = -(kLuminanceWeights.r * red + kLuminanceWeights.b * blue) / kLuminanceWeights.g;
  return {red, green, blue};
}

/// How the hue of all texels changes with the directions: for each pair the four numbers that,
/// times the first two weights, come closest to what a base colour a texel leaves of red and blue.
///
/// `samples`: `[texel][pair]`, n.l included; `basis`: `[pair][component]`; `weights`:
/// `[texel][component]`. The result is `[pair][4]`, finite.
std::vector<float> fitHue(std::span<const glm::vec3> samples, std::span<const float> basis,
                          std::span<const float> weights, std::size_t components, bool weighted);

}  // namespace weft
