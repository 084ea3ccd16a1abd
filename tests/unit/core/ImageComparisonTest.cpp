#include "weft/core/ImageComparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatImage flat(float value) {
  FloatImage image(4, 5, {"R", "G"});
  for (float& v : image.values()) v = value;
  return image;
}

TEST(ImageComparison, EqualImagesDoNotDiffer) {
  const ImageComparison result = compareImages(flat(0.3f), flat(0.3f));
  EXPECT_EQ(result.maximum, 0.0f);
  EXPECT_EQ(result.mean, 0.0);
  EXPECT_EQ(result.failingShare, 0.0);
}

TEST(ImageComparison, MeasuresMaximumMeanAndShare) {
  FloatImage image = flat(0.0f);
  image.at(1, 2, 0) = 0.5f;
  image.at(1, 2, 1) = -0.25f;  // the same pixel
  image.at(3, 4, 1) = 0.125f;
  const ImageComparison result = compareImages(image, flat(0.0f), 0.125f);
  EXPECT_EQ(result.maximum, 0.5f);
  EXPECT_DOUBLE_EQ(result.mean, 0.875 / 40.0);
  EXPECT_DOUBLE_EQ(result.rootMeanSquare, std::sqrt((0.25 + 0.0625 + 0.015625) / 40.0));
  EXPECT_DOUBLE_EQ(result.failingShare, 1.0 / 20.0);  // 0.125 is within the tolerance
}

TEST(ImageComparison, NanIsNeverRight) {
  FloatImage image = flat(0.0f);
  image.at(0, 0, 0) = std::nanf("");
  EXPECT_EQ(compareImages(image, flat(0.0f)).maximum, kInfinity);
  EXPECT_EQ(compareImages(flat(0.0f), image).maximum, kInfinity);
  EXPECT_EQ(compareImages(image, image).maximum, kInfinity);
  EXPECT_EQ(compareImages(image, flat(0.0f), 1.0f).failingShare, 1.0 / 20.0);
}

TEST(ImageComparison, InfinityEqualsItselfAlone) {
  FloatImage image = flat(0.0f);
  image.at(0, 0, 0) = kInfinity;
  EXPECT_EQ(compareImages(image, image).maximum, 0.0f);
  EXPECT_EQ(compareImages(image, flat(0.0f)).maximum, kInfinity);
}

TEST(ImageComparison, OtherShapesAreInfinitelyFarApart) {
  for (const FloatImage& other : {FloatImage(5, 4, {"R", "G"}), FloatImage(4, 5, {"G", "R"}),
                                  FloatImage(4, 5, {"R", "G"}, 2), FloatImage(4, 5, {"R"})}) {
    EXPECT_EQ(compareImages(flat(0.0f), other).maximum, kInfinity);
    EXPECT_EQ(compareImages(flat(0.0f), other).failingShare, 1.0);
  }
}

TEST(ImageComparison, DifferenceImageIsAmplified) {
  FloatImage image = flat(0.5f);
  image.at(2, 1, 1) = 0.25f;
  const FloatImage difference = differenceImage(image, flat(0.5f), 4.0f);
  EXPECT_EQ(difference.at(2, 1, 1), 1.0f);
  EXPECT_EQ(difference.at(0, 0, 0), 0.0f);
}

}  // namespace
}  // namespace weft
