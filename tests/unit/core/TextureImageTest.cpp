#include "weft/core/TextureImage.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

namespace weft {
namespace {

TEST(TextureImage, KeepsSignedBytesInStepsOfTheir127thPart) {
  TextureImage image(1, 1, 2, 4, TexelType::SignedByte);
  const std::vector<float> values{-1.0f, -2.0f, 0.0f, 1.0f / 127.0f, 1.4f / 127.0f, 0.5f, 3.0f};
  image.set(0, 0, 0, 0, values);
  const std::vector<float> kept{-1.0f, -1.0f, 0.0f, 1.0f / 127.0f, 1.0f / 127.0f, 64.0f / 127.0f, 1.0f};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(image.at(0, 0, i / 4, i % 4), kept[static_cast<std::size_t>(i)]) << i;
  EXPECT_EQ(image.byteCount(), 8u);
}

TEST(TextureImage, KeepsThreeNumbersWithOneExponentInFourBytes) {
  TextureImage image(2, 1, 1, 3, TexelType::SharedExponent);
  const std::vector<float> values{2.9f, 0.001f, 0.5f};
  image.set(1, 0, 0, 0, values);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(image.at(1, 0, 0, c), values[static_cast<std::size_t>(c)], 2.9f / 512) << c;
  EXPECT_EQ(image.at(0, 0, 0, 1), 0.0f);
  EXPECT_EQ(image.byteCount(), 8u);
}

TEST(TextureImage, KeepsFloatsAsTheyAreAndRoundsHalfs) {
  for (Precision precision : {Precision::Half, Precision::Float}) {
    TextureImage image(3, 2, 2, 4, texelType(precision));
    const float value = 0.1f;
    image.set(2, 1, 1, 3, {&value, 1});
    EXPECT_EQ(image.at(2, 1, 1, 3), precision == Precision::Half ? roundToHalf(value) : value);
    EXPECT_EQ(image.byteCount(), 3u * 2 * 2 * 4 * (precision == Precision::Half ? 2 : 4));
  }
}

TEST(TextureImage, ValuesGoOnInTheNextLayer) {
  TextureImage image(2, 2, 3, 4, TexelType::Float);
  const std::array values{1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f};
  image.set(1, 0, 0, 3, values);
  EXPECT_EQ(image.at(1, 0, 0, 2), 0.0f);
  EXPECT_EQ(image.at(1, 0, 0, 3), 1.0f);
  EXPECT_EQ(image.at(1, 0, 1, 0), 2.0f);
  EXPECT_EQ(image.at(1, 0, 1, 3), 5.0f);
  EXPECT_EQ(image.at(1, 0, 2, 0), 6.0f);
  EXPECT_EQ(image.at(0, 0, 1, 0), 0.0f);
}

TEST(TextureImage, BytesAreRowsOfTexelsLayerAfterLayer) {
  TextureImage image(2, 3, 2, 1, TexelType::Float);
  float number = 0.0f;
  for (int layer = 0; layer < 2; ++layer)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 2; ++x, ++number) image.set(x, y, layer, 0, {&number, 1});
  std::array<float, 12> values{};
  ASSERT_EQ(image.bytes().size(), sizeof(values));
  std::memcpy(values.data(), image.bytes().data(), sizeof(values));
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], static_cast<float>(i));
}

TEST(TextureImage, LevelsHalveDownToOne) {
  TextureImage image(5, 2, 3, 2, TexelType::Half, 3);
  EXPECT_EQ(image.levels(), 3);
  EXPECT_EQ(image.width(1), 2);
  EXPECT_EQ(image.height(1), 1);
  EXPECT_EQ(image.width(2), 1);
  EXPECT_EQ(image.height(2), 1);
  EXPECT_EQ(image.bytes(1).size(), 2u * 1 * 3 * 2 * 2);
  EXPECT_EQ(image.byteCount(), (10u + 2 + 1) * 3 * 2 * 2);
  const float value = 2.0f;
  image.set(1, 0, 2, 1, {&value, 1}, 1);
  EXPECT_EQ(image.at(1, 0, 2, 1, 1), 2.0f);
}

TEST(TextureImage, IsEmptyWithoutTexels) {
  EXPECT_TRUE(TextureImage().empty());
  EXPECT_EQ(TextureImage().byteCount(), 0u);
}

}  // namespace
}  // namespace weft
