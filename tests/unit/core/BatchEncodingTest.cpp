#include "weft/core/BatchEncoding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace weft {
namespace {

TEST(BatchEncoding, EqualsTheEncodingOfSingleValues) {
  for (Encoding encoding : {Encoding::Linear, Encoding::Gamma22, Encoding::Srgb}) {
    std::vector<float> values{0.0f, -0.5f, 1e-35f, 1e-6f, 0.0031f, 0.0404f, 0.0405f, 1.0f, 7.5f};
    for (int i = 0; i < 100; ++i) values.push_back(static_cast<float>(i) / 70.0f);
    std::vector<float> decoded = values;
    std::vector<float> encoded = values;
    decodeAll(encoding, decoded);
    encodeAll(encoding, encoded);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float stored = encode(encoding, values[i]);
      const float linear = decode(encoding, values[i]);
      EXPECT_NEAR(encoded[i], stored, 2e-6f * (1e-3f + stored)) << name(encoding) << " " << values[i];
      EXPECT_NEAR(decoded[i], linear, 2e-6f * (1e-3f + linear)) << name(encoding) << " " << values[i];
    }
  }
}

TEST(BatchEncoding, AnyNumberOfValuesIsFine) {
  for (std::size_t count : {0u, 1u, 15u, 16u, 17u, 33u}) {
    std::vector<float> values(count + 1, 0.25f);
    encodeAll(Encoding::Gamma22, std::span(values).first(count));
    for (std::size_t i = 0; i < count; ++i) EXPECT_NEAR(values[i], std::pow(0.25f, 1.0f / 2.2f), 1e-6f);
    EXPECT_EQ(values[count], 0.25f) << "beyond the end";
  }
}

}  // namespace
}  // namespace weft
