#include "weft/io/EnvironmentFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "TestSupport.h"
#include "weft/core/AtomicFile.h"
#include "weft/io/ExrFile.h"
#include "weft/io/FileBytes.h"

namespace weft::test {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

Bytes radiance(const std::string& header, std::initializer_list<int> pixels) {
  Bytes bytes(header.begin(), header.end());
  for (const int byte : pixels) bytes.push_back(static_cast<std::uint8_t>(byte));
  return bytes;
}

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";

void expectPixel(const FloatImage& image, int x, int y, glm::vec3 rgb) {
  for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(x, y, c), rgb[c]) << x << " " << y;
}

TEST(Radiance, FlatPixels) {
  const FloatImage image =
      valueOf(decodeRadiance(radiance(kHeader + "-Y 1 +X 2\n", {128, 64, 0, 129, 200, 100, 50, 0}), "a.hdr"));
  expectPixel(image, 0, 0, {1.0f, 0.5f, 0.0f});
  expectPixel(image, 1, 0, {0, 0, 0});
}

TEST(Radiance, OldRuns) {
  const FloatImage image =
      valueOf(decodeRadiance(radiance(kHeader + "-Y 1 +X 4\n", {128, 64, 32, 129, 1, 1, 1, 3}), "a.hdr"));
  expectPixel(image, 3, 0, {1.0f, 0.5f, 0.25f});
}

TEST(Radiance, NewRunsAndExposure) {
  const FloatImage image =
      valueOf(decodeRadiance(radiance("#?RGBE\nEXPOSURE=2\nEXPOSURE= 2\n\n-Y 1 +X 8\n",
                                      {2, 2, 0, 8, 136, 128, 2, 64, 32, 134, 16, 136, 8, 136, 129}),
                             "a.hdr"));
  expectPixel(image, 0, 0, {0.25f, 0.125f, 0.015625f});
  expectPixel(image, 7, 0, {0.25f, 0.03125f, 0.015625f});
}

TEST(Radiance, WhatIsNotSupportedIsSaid) {
  const auto message = [](const Bytes& bytes) {
    const auto image = decodeRadiance(bytes, "a.hdr");
    return image ? std::string() : image.error().message();
  };
  EXPECT_THAT(message(radiance("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", {0, 0, 0, 0})),
              HasSubstr("not in RGBE"));
  EXPECT_THAT(message(radiance(kHeader + "+Y 1 +X 1\n", {0, 0, 0, 0})), HasSubstr("+Y 1"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 99999 +X 99999\n", {})), HasSubstr("99999"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 16384 +X 4096\n", {0, 0, 0, 0})), HasSubstr("truncated"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 1 +X 9\n", {2, 2, 0, 9, 0})), HasSubstr("row 0"));
  EXPECT_THAT(message(radiance(kHeader + "-Y 1 +X 4\n", {1, 2, 3, 4, 1, 1, 1, 200})), HasSubstr("row 0"));
  EXPECT_THAT(message({}), HasSubstr("not a Radiance"));
}

TEST(Radiance, DamagedFilesAreErrorsOrPictures) {
  WEFT_DATA_FILE(file, "hdr/studio.hdr");
  const Bytes whole = valueOf(readFileBytes(file, kLargestImageFile));
  const FloatImage picture = valueOf(decodeRadiance(whole, "studio"));
  EXPECT_EQ(picture.width(), 1024);
  EXPECT_EQ(picture.height(), 512);
  std::mt19937 random(5);
  for (int i = 0; i < 30; ++i) {
    Bytes damaged = whole;
    for (int j = 0; j < 4; ++j)
      damaged[random() % (i < 15 ? 120 : damaged.size())] = static_cast<std::uint8_t>(random());
    if (i % 3 == 0) damaged.resize(random() % damaged.size());
    (void)decodeRadiance(damaged, "damaged");
  }
}

TEST(EnvironmentFile, OpenExrIsReadToo) {
  FloatImage image(4, 2, {"R", "G", "B"});
  image.at(2, 1, 1) = 7.0f;
  const auto file = testFolder() / "a.exr";
  requireDone(writeExr(file, image));
  std::vector<std::string> warnings;
  EXPECT_EQ(valueOf(readEnvironment(file, warnings)).texel(2, 1), glm::vec3(0, 7, 0));
  EXPECT_TRUE(warnings.empty());
  requireDone(writeWholeFile(testFolder() / "b.hdr", "no picture"));
  EXPECT_THAT(readEnvironment(testFolder() / "b.hdr", warnings).error().message(), HasSubstr("b.hdr"));
}

// What comes from the cache is what was made; what is damaged there is made again.
TEST(EnvironmentCache, GivesBackWhatItWasGiven) {
  const Environment environment = valueOf(Environment::builtin("studio")).reduced(64, 32);
  const auto folder = testFolder() / "cache";
  const PrefilteredEnvironment made = prefilter(environment, folder);
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  const std::filesystem::path file = std::filesystem::directory_iterator(folder)->path();
  const auto expectSame = [&](const PrefilteredEnvironment& other) {
    EXPECT_EQ(other.scale, made.scale);
    EXPECT_TRUE(std::ranges::equal(other.lobes.values(), made.lobes.values()));
    EXPECT_TRUE(std::ranges::equal(other.moments.values(), made.moments.values()));
    EXPECT_TRUE(std::ranges::equal(other.glossy.values(), made.glossy.values()));
    EXPECT_EQ(other.lobes.precision(), Precision::Half);
  };
  expectSame(prefilter(environment, folder));
  std::filesystem::resize_file(file, 1000);
  expectSame(prefilter(environment, folder));
  EXPECT_GT(std::filesystem::file_size(file), 1000u);
}

}  // namespace
}  // namespace weft::test
