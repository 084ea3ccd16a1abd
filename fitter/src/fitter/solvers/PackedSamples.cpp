#include "solvers/PackedSamples.h"

#include <Imath/half.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "weft/core/Contract.h"

namespace weft {

void packSamples(std::span<const float> values, std::vector<double>& packed) {
  constexpr float largest = 65504.0f;
  std::array<half, 4> four{};
  for (std::size_t i = 0; i < values.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k)
      four[k] = i + k < values.size() ? half(std::clamp(values[i + k], -largest, largest)) : half(0.0f);
    std::memcpy(&packed.emplace_back(), four.data(), sizeof(double));
  }
}

void unpackSamples(std::span<const double> packed, std::span<float> values) {
  WEFT_EXPECT(packed.size() == packedSize(values.size()), "as many samples as were packed");
  std::array<half, 4> four{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 4 == 0) std::memcpy(static_cast<void*>(four.data()), &packed[i / 4], sizeof(double));
    values[i] = four[i % 4];
  }
}

}  // namespace weft
