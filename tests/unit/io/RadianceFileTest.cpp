#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "TestImages.h"
#include "TestSupport.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/io/FileBytes.h"

namespace weft::test {
namespace {

using testing::HasSubstr;

Bytes radiance(const std::string& header, std::initializer_list<int> pixels) {
  Bytes bytes(header.begin(), header.end());
  for (const int byte : pixels) bytes.push_back(static_cast<std::uint8_t>(byte));
  return bytes;
}

Result<FloatImage> decoded(const Bytes& bytes) {
  std::vector<std::string> warnings;
  return decodeRadiance(bytes, "a.hdr", warnings);
}

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

void expectPixel(const FloatImage& image, int x, int y, glm::vec3 rgb) {
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(x, y, c), rgb[c]) << x << " " << y;
}

TEST(Radiance, FlatPixels) {
  const FloatImage image =
      valueOf(decoded(radiance(kHeader + "-Y 1 +X 2\n", {128, 64, 0, 129, 200, 100, 50, 0})));
  expectPixel(image, 0, 0, {1.0f, 0.5f, 0.0f});
  expectPixel(image, 1, 0, {0, 0, 0});
}

TEST(Radiance, OldRuns) {
  const FloatImage image =
      valueOf(decoded(radiance(kHeader + "-Y 1 +X 4\n", {128, 64, 32, 129, 1, 1, 1, 3})));
  expectPixel(image, 3, 0, {1.0f, 0.5f, 0.25f});
}

TEST(Radiance, NewRunsAndExposure) {
  const FloatImage image =
      valueOf(decoded(radiance("#?RGBE\nEXPOSURE=2\nEXPOSURE= 2\n\n-Y 1 +X 8\n",
                               {2, 2, 0, 8, 136, 128, 2, 64, 32, 134, 16, 136, 8, 136, 129})));
  expectPixel(image, 0, 0, {0.25f, 0.125f, 0.015625f});
  expectPixel(image, 7, 0, {0.25f, 0.03125f, 0.015625f});
}

TEST(Radiance, WhatIsNotSupportedIsSaid) {
  const auto message = [](const Bytes& bytes) {
    const auto image = decoded(bytes);
    return image ? std::string() : image.error().message();
  };
  EXPECT_THAT(message(radiance("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", {0, 0, 0, 0})),
              HasSubstr("not in RGBE"));
  EXPECT_THAT(message(radiance(kHeader + "+Y 1 +Y 1\n", {0, 0, 0, 0})), HasSubstr("+Y 1"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 99999 +X 99999\n", {})), HasSubstr("99999"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 16384 +X 4096\n", {0, 0, 0, 0})), HasSubstr("truncated"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 1 +X 9\n", {2, 2, 0, 9, 0})), HasSubstr("row 0"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 1 +X 4\n", {1, 2, 3, 4, 1, 1, 1, 200})), HasSubstr("row 0"));
  EXPECT_THAT(message({}), HasSubstr("not a Radiance"));
}

TEST(Radiance, DamagedFilesAreErrorsOrPictures) {
  WEFT_DATA_FILE(file, "hdr/studio.hdr");
  const Bytes whole = valueOf(readFileBytes(file, kLargestImageFile));
  const FloatImage picture = valueOf(decoded(whole));
  EXPECT_EQ(picture.width(), 1024);
  EXPECT_EQ(picture.height(), 512);
  std::mt19937 random(5);
  for (int i = 0; i < 30; ++i) {
    Bytes damaged = whole;
    for (int j = 0; j < 4; ++j)
      damaged[random() % (i < 15 ? 120 : damaged.size())] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) damaged.resize(random() % damaged.size());
    (void)decoded(damaged);
  }
}

/// Pixels of red 1, 2, 3, ... flat, in the order of the file.
Bytes counted(const std::string& header, int count) {
  Bytes bytes = radiance(header, {});
  for (int i = 1; i <= count; ++i)
    for (const int byte : {i, 0, 0, 136}) bytes.push_back(static_cast<std::uint8_t>(byte));
  return bytes;
}

std::vector<float> reds(const FloatImage& image) {
  std::vector<float> values;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) values.push_back(image.at(x, y, 0));
  return values;
}

TEST(Radiance, HeadersOfAllHands) {
  for (const std::string header : {
           "#?RADIANCE\nFORMAT=32-bit_rle_rgbe \n\n-Y 2 +X 3\n",
           "#?RADIANCE\n# FORMAT=32-bit_rle_xyze\n FORMAT =\t32-bit_rle_rgbe\n\n-Y  2 +X  3 \n",
           "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 2 +X 3\r\n",
           "#?RADIANCE\rFORMAT=32-bit_rle_rgbe\r\r-Y 2 +X 3\r",
           "#?RGBE\nVIEW= -vtv -vh 45\nno variable\n \n-Y 2 +X 3\n",
           "#?AUTOPANO\n-Y 2 +X 3\n",  // without the empty line
       }) {
    const auto image = decoded(counted(header, 6));
    ASSERT_TRUE(image) << header << image.error().message();
    EXPECT_EQ(reds(*image), (std::vector<float>{1, 2, 3, 4, 5, 6})) << header;
  }
}

TEST(Radiance, AllOrdersOfPixels) {
  const auto read = [](const std::string& size) {
    return reds(valueOf(decoded(counted(kHeader + size, 6))));
  };
  EXPECT_EQ(read("-Y 2 +X 3\n"), (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read("+Y 2 +X 3\n"), (std::vector<float>{4, 5, 6, 1, 2, 3}));
  EXPECT_EQ(read("-Y 2 -X 3\n"), (std::vector<float>{3, 2, 1, 6, 5, 4}));
  EXPECT_EQ(read("+Y 2 -X 3\n"), (std::vector<float>{6, 5, 4, 3, 2, 1}));
  EXPECT_EQ(read("+X 3 -Y 2\n"), (std::vector<float>{1, 3, 5, 2, 4, 6}));
  EXPECT_EQ(read("-X 3 -Y 2\n"), (std::vector<float>{5, 3, 1, 6, 4, 2}));
  EXPECT_EQ(read("+X 3 +Y 2\n"), (std::vector<float>{2, 4, 6, 1, 3, 5}));
}

// ATRIUM's measurements say columns first, and hold rows from the lowest up.
TEST(Radiance, RowsUnderAHeaderOfColumns) {
  std::vector<std::string> warnings;
  const Bytes square = counted(kHeader + "+X 2 -Y 2\n", 4);
  EXPECT_EQ(reds(valueOf(decodeRadiance(square, "a.hdr", warnings))), (std::vector<float>{3, 4, 1, 2}));
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("rows from the lowest up")));
  // Run lengths say how long a line is: 9 is the width, 8 the height.
  const auto line = [](int length, int red) {
    return std::vector<int>{
        2, 2, 0, length, 128 + length, red, 128 + length, 0, 128 + length, 0, 128 + length, 136};
  };
  const auto picture = [&](int lines, int length) {
    Bytes bytes = radiance(kHeader + "+X 9 -Y 8\n", {});
    for (int i = 1; i <= lines; ++i)
      for (const int byte : line(length, i)) bytes.push_back(static_cast<std::uint8_t>(byte));
    return valueOf(decoded(bytes));
  };
  EXPECT_EQ(picture(8, 9).at(0, 0, 0), 8.0f);
  EXPECT_EQ(picture(8, 9).at(8, 7, 0), 1.0f);
  EXPECT_EQ(picture(9, 8).at(0, 7, 0), 1.0f);
  EXPECT_EQ(picture(9, 8).at(8, 0, 0), 9.0f);
}

TEST(Radiance, ColourCorrectionAndPrimaries) {
  const std::string size = "\n-Y 1 +X 1\n";
  const auto pixel = [&](const std::string& variable, std::initializer_list<int> rgbe) {
    const FloatImage image = valueOf(decoded(radiance("#?RADIANCE\n" + variable + size, rgbe)));
    return glm::vec3(image.at(0, 0, 0), image.at(0, 0, 1), image.at(0, 0, 2));
  };
  const auto corrected = pixel("COLORCORR= 2 1 .5\n", {8, 8, 8, 136});
  EXPECT_EQ(corrected, glm::vec3(4, 8, 16));
  // Rec. 2020: its white is ours, its red lies outside.
  const std::string rec2020 = "PRIMARIES= .708 .292 .17 .797 .131 .046 .3127 .329\n";
  const auto white = pixel(rec2020, {100, 100, 100, 136});
  const auto red = pixel(rec2020, {100, 0, 0, 136});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 100.0f, 0.01f);
  EXPECT_NEAR(red.x, 166.05f, 0.1f);
  EXPECT_NEAR(red.y, -12.46f, 0.1f);
  EXPECT_NEAR(red.z, -1.82f, 0.1f);
}

TEST(Radiance, WhatIsIgnoredIsSaid) {
  const auto warningsOf = [](const std::string& variable) {
    std::vector<std::string> warnings;
    const Bytes bytes = radiance("#?RADIANCE\n" + variable + "\n\n-Y 1 +X 1\n", {1, 1, 1, 136});
    (void)valueOf(decodeRadiance(bytes, "a.hdr", warnings));
    return warnings;
  };
  EXPECT_THAT(warningsOf("GAMMA=2.2"), testing::ElementsAre(HasSubstr("gamma")));
  EXPECT_THAT(warningsOf("GAMMA=1.0"), testing::IsEmpty());
  EXPECT_THAT(warningsOf("PRIMARIES= 1 0 1 0 1 0 1 0"), testing::ElementsAre(HasSubstr("no colours")));
  EXPECT_THAT(warningsOf("PRIMARIES=0 0 0 0 0 0 0 0"), testing::IsEmpty());  // Photoshop's
}

// Old run lengths pack a row of any width into twelve bytes, so a claim is only known by reading
// the rows.
TEST(Radiance, ClaimsAreProvedBeforeMemoryIsTaken) {
  const auto picture = [](const std::string& size, int rows) {
    Bytes bytes = radiance(kHeader + size, {});
    for (int row = 0; row < rows; ++row)
      for (const int byte : {9, 9, 9, 136, 1, 1, 1, 255, 1, 1, 1, 15})
        bytes.push_back(static_cast<std::uint8_t>(byte));
    return bytes;
  };
  const std::uint64_t before = peakMemory();
  const auto image = decoded(picture("-Y 16384 +X 4096\n", 16383));
  ASSERT_FALSE(image);
  EXPECT_THAT(image.error().message(), HasSubstr("row 16383 of the Radiance picture is truncated"));
  EXPECT_LT(peakMemory() - before, std::uint64_t{100} << 20);
  EXPECT_EQ(valueOf(decoded(picture("-Y 100 +X 4096\n", 100))).at(4095, 99, 2), 9.0f);
}

}  // namespace
}  // namespace weft::test
