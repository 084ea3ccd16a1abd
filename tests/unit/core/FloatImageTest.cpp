#include "weft/core/FloatImage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace weft {
namespace {

// The value of a half from its bits, by IEEE 754's definition.
float halfValue(unsigned bits) {
  const unsigned exponent = bits >> 10 & 31;
  const float fraction = static_cast<float>(bits & 1023);
  const float sign = bits & 0x8000 ? -1.0f : 1.0f;
  if (exponent == 31) return fraction == 0.0f ? sign * std::numeric_limits<float>::infinity() : std::nanf("");
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024.0f + fraction, static_cast<int>(exponent) - 25);
}

TEST(RoundToHalf, KeepsEveryHalf) {
  for (unsigned bits = 0; bits < 0x10000; ++bits) {
    const float value = halfValue(bits);
    if (std::isnan(value))
      ASSERT_TRUE(std::isnan(roundToHalf(value)));
    else
      ASSERT_EQ(roundToHalf(value), value) << bits;
    ASSERT_EQ(std::signbit(roundToHalf(value)), std::signbit(value)) << bits;
  }
}

TEST(RoundToHalf, RoundsToTheNearestAndTiesToEven) {
  for (unsigned bits = 0; bits < 0x7bff; ++bits)  // up to the largest finite one
    for (const float sign : {1.0f, -1.0f}) {
      const float below = halfValue(bits);
      const float above = halfValue(bits + 1);
      const float middle = 0.5f * (below + above);  // exact in float
      ASSERT_EQ(roundToHalf(sign * middle), sign * (bits % 2 == 0 ? below : above)) << bits;
      ASSERT_EQ(roundToHalf(sign * std::nextafter(middle, 0.0f)), sign * below) << bits;
      ASSERT_EQ(roundToHalf(sign * std::nextafter(middle, 1e9f)), sign * above) << bits;
    }
}

TEST(RoundToHalf, OverflowsToInfinity) {
  EXPECT_EQ(roundToHalf(std::nextafter(65520.0f, 0.0f)), 65504.0f);
  EXPECT_EQ(roundToHalf(65520.0f), std::numeric_limits<float>::infinity());
  EXPECT_EQ(roundToHalf(-1e30f), -std::numeric_limits<float>::infinity());
}

TEST(FloatImage, IsInterleavedByLayerRowColumnChannel) {
  FloatImage image(3, 2, {"a", "b"}, 4);
  EXPECT_EQ(image.values().size(), 3u * 2 * 2 * 4);
  for (float value : image.values()) EXPECT_EQ(value, 0.0f);
  for (std::size_t i = 0; i < image.values().size(); ++i) image.values()[i] = static_cast<float>(i);
  float expected = 0.0f;
  for (int layer = 0; layer < 4; ++layer) {
    EXPECT_EQ(image.layerValues(layer).front(), expected);
    EXPECT_EQ(image.layerValues(layer).size(), 12u);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x) {
        EXPECT_EQ(image.texel(x, y, layer).size(), 2u);
        EXPECT_EQ(image.texel(x, y, layer)[1], expected + 1.0f);
        for (int c = 0; c < 2; ++c) EXPECT_EQ(image.at(x, y, c, layer), expected++);
      }
  }
}

TEST(FloatImage, FindsChannelsByName) {
  const FloatImage image(1, 1, {"R", "lobe0.x"});
  EXPECT_EQ(image.channelIndex("lobe0.x"), 1);
  EXPECT_EQ(image.channelIndex("r"), std::nullopt);
  EXPECT_EQ(image.channelCount(), 2);
  EXPECT_FALSE(image.empty());
  EXPECT_TRUE(FloatImage().empty());
}

TEST(FloatImage, RemembersItsPrecision) {
  FloatImage image(1, 1, {"a", "b"});
  EXPECT_EQ(image.precision(), Precision::Float);
  image.at(0, 0, 0) = 0.1f;
  image.roundToHalf();
  EXPECT_EQ(image.precision(), Precision::Half);
  EXPECT_EQ(image.at(0, 0, 0), 0.0999755859375f);
}

TEST(FloatImageDeathTest, RefusesImpossibleShapes) {
  EXPECT_DEATH(FloatImage(0, 1, {"a"}), "positive size");
  EXPECT_DEATH(FloatImage(1, 1, {}), "positive size");
  EXPECT_DEATH(FloatImage(1, 1, {"a", "a"}), "distinct");
  EXPECT_DEATH(FloatImage(1, 1, {""}), "distinct");
}

}  // namespace
}  // namespace weft
