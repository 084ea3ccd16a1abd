#include "weft/core/Color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace weft {
namespace {

// IEC 61966-2-1, in doubles.
double srgbDecoded(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}
double srgbEncoded(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

TEST(Color, FollowsTheDefinitions) {
  for (int i = 0; i <= 4096; ++i) {
    const double value = i / 2048.0;  // 0 to 2: values above 1 follow the same curve
    const float v = static_cast<float>(value);
    EXPECT_NEAR(decode(Encoding::Srgb, v), srgbDecoded(value), 2e-6 * (1 + srgbDecoded(value)));
    EXPECT_NEAR(encode(Encoding::Srgb, v), srgbEncoded(value), 2e-6);
    EXPECT_NEAR(decode(Encoding::Gamma22, v), std::pow(value, 2.2), 2e-6 * (1 + std::pow(value, 2.2)));
    EXPECT_NEAR(encode(Encoding::Gamma22, v), std::pow(value, 1.0 / 2.2), 2e-6);
    EXPECT_EQ(decode(Encoding::Linear, v), v);
    EXPECT_EQ(encode(Encoding::Linear, v), v);
  }
}

TEST(Color, HitsPublishedValues) {
  EXPECT_NEAR(decode(Encoding::Srgb, 0.5f), 0.2140411f, 1e-6f);   // the sRGB mid-grey
  EXPECT_NEAR(encode(Encoding::Srgb, 0.18f), 0.4613561f, 1e-6f);  // an 18 % grey card
  EXPECT_NEAR(decode(Encoding::Gamma22, 0.5f), 0.2176376f, 1e-6f);
}

TEST(Color, RoundTrips) {
  for (Encoding encoding : {Encoding::Linear, Encoding::Gamma22, Encoding::Srgb})
    for (int i = 0; i <= 1000; ++i) {
      const float linear = static_cast<float>(i) / 500.0f;
      EXPECT_NEAR(decode(encoding, encode(encoding, linear)), linear, 3e-6f);
    }
}

TEST(Color, MakesNegativeValuesZero) {
  for (Encoding encoding : {Encoding::Linear, Encoding::Gamma22, Encoding::Srgb}) {
    EXPECT_EQ(decode(encoding, -0.5f), 0.0f);
    EXPECT_EQ(encode(encoding, -0.5f), 0.0f);
  }
}

TEST(Color, TreatsChannelsAlike) {
  const glm::vec3 value(0.001f, 0.4f, 1.7f);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(encode(Encoding::Srgb, value)[c], encode(Encoding::Srgb, value[c]));
    EXPECT_EQ(decode(Encoding::Gamma22, value)[c], decode(Encoding::Gamma22, value[c]));
  }
}

TEST(Color, NamesRoundTrip) {
  for (Encoding encoding : {Encoding::Linear, Encoding::Gamma22, Encoding::Srgb}) {
    ASSERT_TRUE(encodingFromName(name(encoding)));
    EXPECT_EQ(*encodingFromName(name(encoding)), encoding);
  }
  const auto unknown = encodingFromName("rec2020");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().message(), "unknown encoding 'rec2020' (linear, gamma2.2 or srgb)");
}

TEST(Color, LuminanceIsRec709) {
  EXPECT_FLOAT_EQ(luminance(glm::vec3(1.0f)), 1.0f);
  EXPECT_FLOAT_EQ(luminance({1, 0, 0}), 0.2126f);
  EXPECT_FLOAT_EQ(luminance({0, 1, 0}), 0.7152f);
  EXPECT_FLOAT_EQ(luminance({0, 0, 1}), 0.0722f);
  // Luminance of encoded values is not the encoding of luminance; errors are defined on the former.
  const glm::vec3 blue(0.1f, 0.1f, 0.9f);
  EXPECT_GT(std::abs(luminance(encode(Encoding::Srgb, blue)) - encode(Encoding::Srgb, luminance(blue))),
            0.01f);
}

}  // namespace
}  // namespace weft
