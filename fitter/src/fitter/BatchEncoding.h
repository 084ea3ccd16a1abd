#pragma once

#include <span>

#include "weft/core/Color.h"

namespace weft {

/// decode() of core/Color.h for many values in place, as many at once as the processor has SIMD lanes;
/// relative error below 1e-6.
void decodeAll(Encoding encoding, std::span<float> values);
/// encode(), likewise.
void encodeAll(Encoding encoding, std::span<float> values);

}  // namespace weft
