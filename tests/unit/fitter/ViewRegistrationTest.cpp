#include "solvers/ViewRegistration.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <random>

#include "weft/core/Direction.h"

namespace weft {
namespace {

std::vector<glm::vec3> rings(int upTo) {
  std::vector<glm::vec3> directions{{0.0f, 0.0f, 1.0f}};
  for (int ring = 1; ring <= upTo; ++ring)
    for (int i = 0; i < 6 * ring; ++i)
      directions.push_back(directionFromDegrees(15.0 * ring, 60.0 * i / ring));
  return directions;
}

std::vector<glm::ivec2> predicted(const std::vector<glm::vec3>& views, float height) {
  std::vector<glm::ivec2> offsets;
  for (glm::vec3 view : views) {
    const glm::vec2 shift = height / view.z * glm::vec2(view.x, view.y);
    offsets.emplace_back(std::lround(shift.x), std::lround(shift.y));
  }
  return offsets;
}

struct Texture {
  int size;
  std::vector<glm::vec4> texels;  // normal and albedo

  glm::vec4 at(int column, int row) const {
    const auto wrapped = [&](int i) { return (i % size + size) % size; };
    return texels[static_cast<std::size_t>(wrapped(row) * size + wrapped(column))];
  }
};

Texture reliefOf(int size) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Texture texture{size, {}};
  for (int i = 0; i < size * size; ++i) {
    const glm::vec3 normal = glm::normalize(glm::vec3(unit(random) - 0.5f, unit(random) - 0.5f, 1.0f));
    texture.texels.emplace_back(normal, 0.2f + 0.6f * unit(random));
  }
  return texture;
}

// What a camera records of a matte relief whose views are shifted so: pixel x shows X = x + offset.
LuminanceWindow windowOf(const Texture& texture, const std::vector<glm::vec3>& views,
                         const std::vector<glm::ivec2>& offsets, int size, bool wraps) {
  const std::vector<glm::vec3> lights = rings(1);
  LuminanceWindow window{size, size, views, static_cast<int>(lights.size()), {}, wraps};
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      for (glm::ivec2 offset : offsets) {
        const glm::vec4 texel = texture.at(column + offset.x, row - offset.y);
        for (glm::vec3 light : lights) {
          const float linear = texel.w * std::max(glm::dot(glm::vec3(texel), light), 0.0f);
          window.values.push_back(
              static_cast<std::uint8_t>(std::lround(255.0f * std::pow(linear, 1.0f / 2.2f))));
        }
      }
  return window;
}

class KnownHeight : public testing::TestWithParam<float> {};

TEST_P(KnownHeight, IsFoundWithTheOffsets) {
  const std::vector<glm::vec3> views = rings(4);
  const std::vector<glm::ivec2> offsets = predicted(views, GetParam());
  const ViewShifts found = registerViews(windowOf(reliefOf(48), views, offsets, 48, true));
  EXPECT_NEAR(found.height, GetParam(), 0.25f);
  EXPECT_EQ(found.offsets, offsets);
}

INSTANTIATE_TEST_SUITE_P(Heights, KnownHeight, testing::Values(0.0f, 2.0f, 4.5f, -3.0f));

TEST(ViewRegistration, ViewsThatAreOffAreCorrected) {
  const std::vector<glm::vec3> views = rings(4);
  std::vector<glm::ivec2> offsets = predicted(views, 3.0f);
  offsets[9] += glm::ivec2(1, -2);
  offsets[40] += glm::ivec2(0, 1);
  const ViewShifts found = registerViews(windowOf(reliefOf(48), views, offsets, 48, true));
  EXPECT_NEAR(found.height, 3.0f, 0.25f);
  EXPECT_EQ(found.offsets, offsets);
}

TEST(ViewRegistration, APartOfTheSampleDoes) {
  const std::vector<glm::vec3> views = rings(4);
  const std::vector<glm::ivec2> offsets = predicted(views, 3.0f);
  const ViewShifts found = registerViews(windowOf(reliefOf(100), views, offsets, 64, false));
  EXPECT_NEAR(found.height, 3.0f, 0.25f);
  EXPECT_EQ(found.offsets, offsets);
}

TEST(ViewRegistration, WhatHasNothingToAlignIsNotShifted) {
  const Texture texture = reliefOf(24);
  const Texture plain{1, {{0.0f, 0.0f, 1.0f, 0.5f}}};
  const Texture black{1, {{0.0f, 0.0f, 1.0f, 0.0f}}};
  const std::vector<glm::vec3> views = rings(3);
  const std::vector<glm::ivec2> none(views.size(), glm::ivec2(0));
  std::vector<LuminanceWindow> windows{
      windowOf(plain, views, none, 24, true), windowOf(black, views, none, 24, true),
      windowOf(plain, views, none, 1, true), windowOf(texture, views, none, 3, false),
      windowOf(texture, {views[0]}, {none[0]}, 24, true)};
  windows.push_back({24, 24, views, 0, {}, true});
  for (const LuminanceWindow& window : windows) {
    const ViewShifts found = registerViews(window);
    EXPECT_EQ(found.height, 0.0f);
    EXPECT_EQ(found.offsets, std::vector<glm::ivec2>(window.views.size()));
  }
}

TEST(ViewRegistration, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<glm::vec3> views = rings(3);
  const LuminanceWindow window = windowOf(reliefOf(40), views, predicted(views, 1.5f), 40, true);
  const ViewShifts found = registerViews(window);
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const ViewShifts again = registerViews(window);
  EXPECT_EQ(again.height, found.height);
  EXPECT_EQ(again.offsets, found.offsets);
}

}  // namespace
}  // namespace weft
