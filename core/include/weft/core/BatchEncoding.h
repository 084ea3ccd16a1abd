#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "weft/core/Color.h"

namespace weft {

/// decode() of core/Color.h for many values in place, as many at once as the processor has SIMD
/// lanes; relative error below 1e-6.
void decodeAll(Encoding encoding, std::span<float> values);
/// encode(), likewise.
void encodeAll(Encoding encoding, std::span<float> values);

/// The floats of colours, three each.
inline std::span<float> floatsOf(std::span<glm::vec3> colors) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  return {&colors.data()->x, 3 * colors.size()};
}

}  // namespace weft
