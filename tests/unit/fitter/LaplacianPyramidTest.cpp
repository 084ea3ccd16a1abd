#include "solvers/LaplacianPyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec2.hpp>

namespace weft {
namespace {

NumberImage emptyImage(int width, int height, std::size_t numbers = 1) {
  NumberImage image{width, height, numbers, {}};
  image.values.resize(image.texels() * numbers);
  return image;
}

NumberImage unevenImage(int width, int height, std::size_t numbers) {
  NumberImage image = emptyImage(width, height, numbers);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = std::sin(0.37f * static_cast<float>(i * i % 1009));
  return image;
}

double sumOf(const NumberImage& image) {
  double sum = 0.0;
  for (const float value : image.values) sum += double{value};
  return sum;
}

/// As a share of the sides.
glm::dvec2 centroidOf(const NumberImage& image) {
  glm::dvec2 sum(0.0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      sum += double{*image.at(x, y)} * glm::dvec2((x + 0.5) / image.width, (y + 0.5) / image.height);
  return sum / sumOf(image);
}

TEST(LaplacianPyramid, WhatIsLeftOfAllLevelsGivesTheImageBack) {
  for (const auto& [width, height] : {std::pair(16, 16), {37, 50}, {1, 7}}) {
    const std::vector<NumberImage> levels = gaussianPyramid(unevenImage(width, height, 2), 3);
    NumberImage sum = levels.back();
    for (std::size_t level = levels.size() - 1; level-- > 0;) {
      NumberImage shown = enlarged(sum, levels[level].width, levels[level].height);
      const NumberImage ofCoarser = enlarged(levels[level + 1], levels[level].width, levels[level].height);
      for (std::size_t i = 0; i < shown.values.size(); ++i)
        shown.values[i] += levels[level].values[i] - ofCoarser.values[i];
      sum = std::move(shown);
    }
    for (std::size_t i = 0; i < sum.values.size(); ++i)
      EXPECT_NEAR(sum.values[i], levels[0].values[i], 2e-6f) << width;
  }
}

TEST(LaplacianPyramid, ALevelHalvesTheSidesUntilFewTexelsAreLeft) {
  const std::vector<NumberImage> levels = gaussianPyramid(emptyImage(37, 50), 16);
  ASSERT_EQ(levels.size(), 5u);  // 18 x 25, 9 x 12, 4 x 6, 2 x 3
  EXPECT_EQ(levels[4].width, 2);
  EXPECT_EQ(levels[4].height, 3);
  EXPECT_EQ(gaussianPyramid(emptyImage(1, 1), 0).size(), 1u);
}

// An impulse stays where it is on average over the texels of a coarse one; and a coarse one exactly
// where the finer level shows it, across the border too.
TEST(LaplacianPyramid, TheCentroidOfAnImpulseStays) {
  constexpr int kSide = 16;
  for (int level = 1; level <= 3; ++level) {
    const int step = 1 << level;
    glm::dvec2 moved(0.0);
    for (int y = 0; y < step; ++y)
      for (int x = 0; x < step; ++x) {
        NumberImage image = emptyImage(kSide, kSide);
        *image.at(x, y) = 1.0f;
        const glm::dvec2 before = centroidOf(image);
        for (int i = 0; i < level; ++i) image = halved(image);
        EXPECT_NEAR(sumOf(image) * step * step, 1.0, 1e-6);
        moved += centroidOf(image) - before;
      }
    EXPECT_NEAR(moved.x, 0.0, 1e-6);
    EXPECT_NEAR(moved.y, 0.0, 1e-6);
  }
  NumberImage coarse = emptyImage(8, 8);
  *coarse.at(3, 5) = 1.0f;
  const glm::dvec2 shown = centroidOf(enlarged(coarse, kSide, kSide));
  EXPECT_NEAR(shown.x, centroidOf(coarse).x, 1e-6);
  EXPECT_NEAR(shown.y, centroidOf(coarse).y, 1e-6);
}

TEST(LaplacianPyramid, TheSampleRepeats) {
  NumberImage coarse = emptyImage(4, 4);
  *coarse.at(0, 0) = 1.0f;
  const NumberImage fine = enlarged(coarse, 8, 8);
  EXPECT_FLOAT_EQ(*fine.at(7, 7), 1.0f / 16.0f);
  EXPECT_FLOAT_EQ(*fine.at(0, 7), 3.0f / 16.0f);
  EXPECT_NEAR(sumOf(fine), 4.0, 1e-6);
}

}  // namespace
}  // namespace weft
