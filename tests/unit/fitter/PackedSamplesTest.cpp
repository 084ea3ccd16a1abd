#include "solvers/PackedSamples.h"

#include <gtest/gtest.h>

#include "weft/core/FloatImage.h"

namespace weft {
namespace {

TEST(PackedSamples, ComeBackAsHalfs) {
  for (std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{4}, std::size_t{6561}}) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(static_cast<float>(i * 7919 % 6563) / 3000.0f);
    std::vector<double> packed{1.0, 2.0};
    packSamples(values, packed);
    ASSERT_EQ(packed.size(), 2 + packedSize(count));
    std::vector<float> unpacked(count, -1.0f);
    unpackSamples(std::span(packed).subspan(2), unpacked);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(unpacked[i], roundToHalf(values[i])) << i;
  }
}

TEST(PackedSamples, StayFinite) {
  std::vector<double> packed;
  packSamples(std::vector{1e9f, -1e9f, 1e-12f}, packed);
  std::vector<float> unpacked(3);
  unpackSamples(packed, unpacked);
  EXPECT_EQ(unpacked, (std::vector{65504.0f, -65504.0f, 0.0f}));
}

}  // namespace
}  // namespace weft
