// Where a baked BTF shows what: shadows, parallax and repetition against plain geometry.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "BakedSource.h"
#include "TestSupport.h"
#include "weft/baking/BtfBaker.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

constexpr int kTexels = 32;
constexpr int kSamplesPerTexel = 8;
constexpr float kSpacing = 1.0f / kSamplesPerTexel;  // so that a texel is 1 wide

struct Box {
  float left, right, bottom, top;  // x and y in texels, y up
  Box grown(float by) const { return {left - by, right + by, bottom - by, top + by}; }
  bool holds(float x, float y) const { return x >= left && x <= right && y >= bottom && y <= top; }
};

/// Zero but for a plateau of texels [firstColumn, lastColumn] x [firstRow, lastRow] at `height`.
HeightField plateau(int firstColumn, int lastColumn, int firstRow, int lastRow, float height) {
  HeightField field(kTexels * kSamplesPerTexel, kTexels * kSamplesPerTexel, kSpacing);
  for (int row = firstRow * kSamplesPerTexel; row < (lastRow + 1) * kSamplesPerTexel; ++row)
    for (int column = firstColumn * kSamplesPerTexel; column < (lastColumn + 1) * kSamplesPerTexel; ++column)
      field.at(column, row).height = height;
  return field;
}

BakeOptions directOptions(std::vector<glm::vec3> views, std::vector<glm::vec3> lights) {
  BakeOptions options;
  options.width = options.height = kTexels;
  options.samples = 16;
  options.bounces = 0;
  options.views = std::move(views);
  options.lights = std::move(lights);
  return options;
}

/// The red value of a texel under a light.
float red(const std::vector<float>& view, std::size_t light, int column, int row) {
  return view[((light * kTexels + static_cast<std::size_t>(row)) * kTexels +
               static_cast<std::size_t>(column)) *
              3];
}

/// Whether the ground at (x, y) sees a light past a box of that height and its repetitions.
bool isShadowed(Box box, float height, float x, float y, glm::vec3 light) {
  // The ray is inside of the box's height up to this distance across the plane.
  const float reach = height / light.z;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      float enter = 0.0f;
      float leave = reach;
      const auto clip = [&](float position, float direction, float low, float high) {
        if (std::abs(direction) < 1e-6f) {
          if (position < low || position > high) leave = -1.0f;
          return;
        }
        const float a = (low - position) / direction;
        const float b = (high - position) / direction;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
      };
      clip(x, light.x, box.left + static_cast<float>(i * kTexels),
           box.right + static_cast<float>(i * kTexels));
      clip(y, light.y, box.bottom + static_cast<float>(j * kTexels),
           box.top + static_cast<float>(j * kTexels));
      if (enter < leave) return true;
    }
  return false;
}

/// How many of the points of a grid over a texel satisfy a condition of (x, y): none 0, all 1.
template <class Condition>
float coverage(int column, int row, Condition condition) {
  constexpr int kGrid = 9;  // with both edges
  int count = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j)
      count += condition(static_cast<float>(column) + static_cast<float>(i) / (kGrid - 1),
                         -static_cast<float>(row) - static_cast<float>(j) / (kGrid - 1));
  return static_cast<float>(count) / (kGrid * kGrid);
}

TEST(BakeGeometry, ARidgeLitFromTheTopOfTheImageShadowsTheRowsBelow) {
  // Rows 14 and 15 are 4.5 high; at 45 degrees the shadow of row 15's lower edge is 4.5 rows long.
  const HeightField field = plateau(0, kTexels - 1, 14, 15, 4.5f);
  const float level = std::sqrt(0.5f);
  const auto baker = test::valueOf(BtfBaker::create(
      field, directOptions({{0, 0, 1}}, {directionFromDegrees(45, 90), directionFromDegrees(45, 270)})));
  const std::vector<float> view = test::bakedView(baker, 0);
  for (int row = 16; row < 20; ++row) EXPECT_EQ(red(view, 0, 7, row), 0.0f) << row;
  EXPECT_NEAR(red(view, 0, 7, 20), 0.5f * level, 0.1f);
  for (int row : {21, 31, 0, 12}) EXPECT_NEAR(red(view, 0, 7, row), level, 1e-5f) << row;
  // From the bottom of the image the shadow lies on the rows above.
  for (int row = 10; row < 14; ++row) EXPECT_EQ(red(view, 1, 7, row), 0.0f) << row;
  for (int row : {8, 17, 31}) EXPECT_NEAR(red(view, 1, 7, row), level, 1e-5f) << row;
}

TEST(BakeGeometry, APlateauCastsTheShadowOfABoxUnderEveryLight) {
  constexpr float kHeight = 3.3f;
  const HeightField field = plateau(10, 17, 18, 21, kHeight);
  const Box box{10.0f, 18.0f, -22.0f, -18.0f};
  const float half = 0.5f * kSpacing;  // the walls slope over one sample
  const auto baker = test::valueOf(BtfBaker::create(field, directOptions({{0, 0, 1}}, ubo2003Directions())));
  const std::vector<float> view = test::bakedView(baker, 0);
  int dark = 0;
  for (std::size_t light = 0; light < baker.options().lights.size(); ++light) {
    const glm::vec3 l = baker.options().lights[light];
    for (int row = 0; row < kTexels; ++row)
      for (int column = 0; column < kTexels; ++column) {
        const auto touched = [&](float x, float y) { return box.grown(half).holds(x, y); };
        if (coverage(column, row, touched) > 0.0f) continue;
        const auto maybe = [&](float x, float y) { return isShadowed(box.grown(half), kHeight, x, y, l); };
        const auto surely = [&](float x, float y) { return isShadowed(box.grown(-half), kHeight, x, y, l); };
        const float value = red(view, light, column, row);
        if (coverage(column, row, maybe) == 0.0f) {
          ASSERT_NEAR(value, l.z, 1e-5f) << light << " " << column << " " << row;
        } else if (coverage(column, row, surely) == 1.0f) {
          ASSERT_EQ(value, 0.0f) << light << " " << column << " " << row;
          ++dark;
        } else {
          const float lit = 1.0f - 0.5f * (coverage(column, row, maybe) + coverage(column, row, surely));
          ASSERT_NEAR(value / l.z, lit, 0.3f) << light << " " << column << " " << row;
        }
      }
  }
  EXPECT_GT(dark, 1000);
}

TEST(BakeGeometry, APlateauAppearsDisplacedAgainstTheView) {
  constexpr float kHeight = 2.7f;
  HeightField field = plateau(10, 17, 18, 21, kHeight);
  for (HeightField::Sample& sample : field.samples)
    sample.albedo = glm::vec3(sample.height > 0.0f ? 1.0f : 0.0f);
  const Box box{10.0f, 18.0f, -22.0f, -18.0f};
  const auto baker = test::valueOf(BtfBaker::create(field, directOptions(ubo2003Directions(), {{0, 0, 1}})));
  for (int view = 0; view < 81; ++view) {
    const glm::vec3 v = baker.options().views[static_cast<std::size_t>(view)];
    const std::vector<float> picture = test::bakedView(baker, view);
    const auto inside = [&](float by) {
      return [&, by](float x, float y) {
        const auto seenX =
            x + kHeight * v.x / v.z;  // the place of the top that the line through (x, y) meets
        const auto seenY = y + kHeight * v.y / v.z;
        for (int i : {-kTexels, 0, kTexels})
          for (int j : {-kTexels, 0, kTexels})
            if (box.grown(by).holds(seenX + static_cast<float>(i), seenY + static_cast<float>(j)))
              return true;
        return false;
      };
    };
    for (int row = 0; row < kTexels; ++row)
      for (int column = 0; column < kTexels; ++column) {
        const float value = red(picture, 0, column, row);
        // The walls, which slope over one sample, are all but parallel to the light.
        if (coverage(column, row, inside(-kSpacing)) == 1.0f) {
          ASSERT_NEAR(value, 1.0f, 1e-5f) << view << " " << column << " " << row;
        } else if (coverage(column, row, inside(kSpacing)) == 0.0f) {
          ASSERT_LT(value, 0.06f) << view << " " << column << " " << row;
        }
      }
  }
}

TEST(BakeGeometry, WhatLiesInTheReferencePlaneStaysInItsTexelInEveryView) {
  HeightField field(kTexels, kTexels, 1.0f);
  for (int row = 0; row < kTexels; ++row)
    for (int column = 0; column < kTexels; ++column)
      field.at(column, row).albedo =
          glm::vec3(static_cast<float>(column) / kTexels, static_cast<float>(row) / kTexels, 0);
  const auto baker = test::valueOf(BtfBaker::create(field, directOptions(ubo2003Directions(), {{0, 0, 1}})));
  for (int view : {0, 3, 40, 60, 80}) {
    const std::vector<float> picture = test::bakedView(baker, view);
    for (int row = 0; row < kTexels; ++row)
      for (int column = 0; column < kTexels; ++column)
        ASSERT_NEAR(red(picture, 0, column, row), static_cast<float>(column) / kTexels, 0.3f / kTexels);
  }
}

/// Smooth hills that are all but free of symmetry.
HeightField hills(int texels) {
  constexpr float kTurn = 6.2831853f;
  const int samples = texels * 4;
  HeightField field(samples, samples, 0.25f);
  for (int row = 0; row < samples; ++row)
    for (int column = 0; column < samples; ++column) {
      const float x = kTurn * static_cast<float>(column) / static_cast<float>(samples);
      const float y = kTurn * static_cast<float>(row) / static_cast<float>(samples);
      field.at(column, row).height =
          1.2f * std::sin(x) + 0.8f * std::cos(2.0f * y + x) + 0.5f * std::sin(3.0f * x - y);
      field.at(column, row).albedo = glm::vec3(0.6f + 0.3f * std::sin(2.0f * x + y));
    }
  return field;
}

TEST(BakeGeometry, TwoByTwoPeriodsAreTheSameSurface) {
  constexpr int kSize = 12;
  const HeightField one = hills(kSize);
  HeightField four(2 * one.columns, 2 * one.rows, one.spacing);
  for (int row = 0; row < four.rows; ++row)
    for (int column = 0; column < four.columns; ++column) four.at(column, row) = one.atPeriodic(column, row);
  BakeOptions options;
  options.width = options.height = kSize;
  options.bounces = 3;
  options.views = {directionFromDegrees(75, 30), directionFromDegrees(75, 200),
                   directionFromDegrees(30, 100)};
  BakeOptions twice = options;
  twice.width = twice.height = 2 * kSize;
  const auto small = test::valueOf(BtfBaker::create(one, options));
  const auto large = test::valueOf(BtfBaker::create(four, twice));
  for (int view = 0; view < 3; ++view) {
    const std::vector<float> a = test::bakedView(small, view);
    const std::vector<float> b = test::bakedView(large, view);
    double sum = 0.0;
    double difference = 0.0;
    for (std::size_t light = 0; light < 81; ++light)
      for (std::size_t row = 0; row < kSize; ++row)
        // The same texels have the same random numbers.
        for (std::size_t i = 0; i < kSize * 3; ++i) {
          const float value = a[(light * kSize + row) * kSize * 3 + i];
          sum += static_cast<double>(value);
          difference +=
              static_cast<double>(std::abs(value - b[(light * 2 * kSize + row) * 2 * kSize * 3 + i]));
        }
    // A path may round to the other side of an edge.
    EXPECT_LT(difference, 2e-4 * sum) << view;
  }
}

TEST(BakeGeometry, AShiftedSurfaceGivesAShiftedBtf) {
  constexpr int kSize = 12;
  constexpr int kRight = 5;
  constexpr int kDown = 3;
  const HeightField field = hills(kSize);
  HeightField shifted = field;
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < field.columns; ++column)
      shifted.at(column, row) = field.atPeriodic(column - 4 * kRight, row - 4 * kDown);
  BakeOptions options;
  options.width = options.height = kSize;
  options.samples = 256;
  options.bounces = 0;
  options.views = {directionFromDegrees(75, 45)};
  options.lights = {directionFromDegrees(75, 170), directionFromDegrees(60, 300)};
  const std::vector<float> a = test::bakedView(test::valueOf(BtfBaker::create(field, options)), 0);
  const std::vector<float> b = test::bakedView(test::valueOf(BtfBaker::create(shifted, options)), 0);
  double difference = 0.0;
  double unshifted = 0.0;
  for (int light = 0; light < 2; ++light)
    for (int row = 0; row < kSize; ++row)
      for (int column = 0; column < kSize; ++column) {
        const auto at = [&](int c, int r) {
          return static_cast<std::size_t>(((light * kSize + r % kSize) * kSize + c % kSize) * 3);
        };
        const float moved = b[at(column + kRight, row + kDown)];
        difference += static_cast<double>(std::abs(moved - a[at(column, row)])) / (2 * kSize * kSize);
        unshifted +=
            static_cast<double>(std::abs(b[at(column, row)] - a[at(column, row)])) / (2 * kSize * kSize);
      }
  EXPECT_LT(difference, 0.005);
  EXPECT_GT(unshifted, 0.05);
}

}  // namespace
}  // namespace weft
