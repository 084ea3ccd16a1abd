#include <algorithm>
#include <cmath>
#include <string>

#include "TestSupport.h"
#include "weft/baking/Pattern.h"

namespace weft {
namespace {

class BakePattern : public testing::TestWithParam<std::string_view> {};

TEST_P(BakePattern, HasMeanHeightZeroReliefAndABoundedReflectance) {
  const HeightField field = test::valueOf(makePattern(GetParam(), 128));
  double sum = 0.0;
  for (const HeightField::Sample& sample : field.samples) {
    sum += static_cast<double>(sample.height);
    const auto [least, most] = std::minmax({sample.albedo.r, sample.albedo.g, sample.albedo.b});
    ASSERT_GE(least, 0.0f);
    ASSERT_GE(sample.specular, 0.0f);
    ASSERT_LE(most + sample.specular, 1.0f);
  }
  EXPECT_NEAR(sum / static_cast<double>(field.samples.size()), 0.0, 1e-6);
  EXPECT_GT(field.highest() - field.lowest(), 0.03f);
  EXPECT_LT(field.highest() - field.lowest(), 0.2f);
  EXPECT_FLOAT_EQ(field.spacing * static_cast<float>(field.columns), 1.0f);
}

TEST_P(BakePattern, RepeatsWithoutASeam) {
  // The steps from the last to the first column, and row, are like the steps within.
  const HeightField field = test::valueOf(makePattern(GetParam(), 256));
  const auto meanStep = [&](int column, bool acrossColumns) {
    double sum = 0.0;
    for (int i = 0; i < 256; ++i) {
      const float here =
          acrossColumns ? field.atPeriodic(column, i).height : field.atPeriodic(i, column).height;
      const float next =
          acrossColumns ? field.atPeriodic(column + 1, i).height : field.atPeriodic(i, column + 1).height;
      sum += static_cast<double>(std::abs(next - here));
    }
    return sum / 256.0;
  };
  for (const bool acrossColumns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i < 255; ++i) largest = std::max(largest, meanStep(i, acrossColumns));
    EXPECT_LE(meanStep(255, acrossColumns), 1.1 * largest);
  }
}

TEST_P(BakePattern, IsTheSameSurfaceAtEveryResolution) {
  const HeightField coarse = test::valueOf(makePattern(GetParam(), 64));
  const HeightField fine = test::valueOf(makePattern(GetParam(), 192));
  double difference = 0.0;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column)
      difference += static_cast<double>(
          std::abs(coarse.at(column, row).height - fine.at(3 * column + 1, 3 * row + 1).height));
  EXPECT_LT(difference / (64.0 * 64.0), 0.001);
}

INSTANTIATE_TEST_SUITE_P(All, BakePattern, testing::ValuesIn(patternNames()),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(BakePatternNames, AnUnknownOneIsRefusedWithThoseThatAreKnown) {
  const Result<HeightField> field = makePattern("felt", 16);
  ASSERT_FALSE(field);
  EXPECT_NE(field.error().message().find("'felt'"), std::string::npos);
  EXPECT_NE(field.error().message().find("corduroy, weave, tiles, bumps"), std::string::npos);
}

}  // namespace
}  // namespace weft
