#include "weft/reflectance/LightMaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "weft/core/Direction.h"
#include "weft/reflectance/LightMap.h"

namespace weft {
namespace {

std::vector<glm::vec3> rings(const std::vector<std::pair<double, int>>& thetaAndCount) {
  std::vector<glm::vec3> directions;
  for (const auto& [theta, count] : thetaAndCount)
    for (int i = 0; i < count; ++i) directions.push_back(directionFromDegrees(theta, 360.0 * i / count));
  return directions;
}

std::vector<glm::vec3> ubo2003() {
  return rings({{0, 1}, {15, 6}, {30, 12}, {45, 18}, {60, 20}, {75, 24}});
}

std::vector<glm::vec3> domeOf151() {
  return rings({{0, 1}, {11, 6}, {23.5, 12}, {30, 18}, {45, 24}, {60, 30}, {75, 36}, {90, 24}});
}

float sample(const std::vector<float>& map, int size, glm::vec3 light, std::size_t channels = 1,
             std::size_t channel = 0) {
  const glm::vec2 at = lightMapPlace(light, size);
  const int column = std::clamp(static_cast<int>(at.x), 0, size - 2);
  const int row = std::clamp(static_cast<int>(at.y), 0, size - 2);
  const auto texel = [&](int x, int y) {
    return map[static_cast<std::size_t>((row + y) * size + column + x) * channels + channel];
  };
  const float x = at.x - static_cast<float>(column);
  const float y = at.y - static_cast<float>(row);
  return (1 - y) * ((1 - x) * texel(0, 0) + x * texel(1, 0)) + y * ((1 - x) * texel(0, 1) + x * texel(1, 1));
}

glm::vec2 disc(glm::vec3 light) {
  return glm::vec2(light) / std::sqrt(1.0f + light.z);
}

std::vector<float> randomValues(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<float> values(count);
  for (float& value : values) value = unit(random);
  return values;
}

TEST(LightMaps, HaveTwoTexelsForEveryLight) {
  EXPECT_EQ(LightMaps::sizeFor(81), 16);
  EXPECT_EQ(LightMaps::sizeFor(151), 22);
  EXPECT_GE(LightMaps::sizeFor(1), 2);
  EXPECT_EQ(LightMaps(ubo2003()).size(), 16);
}

TEST(LightMaps, EdgesOfTheDiscLieOnOutermostTexels) {
  EXPECT_EQ(lightMapPlace({1, 0, 0}, 16), glm::vec2(15, 7.5));
  EXPECT_EQ(lightMapPlace({0, 1, 0}, 16), glm::vec2(7.5, 15));
  EXPECT_EQ(lightMapPlace({0, 0, 1}, 16), glm::vec2(7.5, 7.5));
}

TEST(LightMaps, AreExactAtTheMeasuredLights) {
  for (const auto& lights :
       {ubo2003(), domeOf151(), rings({{0, 1}, {90, 5}}), rings({{40, 3}}), rings({{20, 2}}),
        rings({{0, 1}, {50, 2}}), rings({{30, 1}, {50, 1}}), rings({{35, 1}})}) {
    const LightMaps maps(lights);
    const std::vector<float> values = randomValues(3 * lights.size());
    const std::vector<float> filled = maps.filled(values, 3);
    ASSERT_EQ(filled.size(), static_cast<std::size_t>(3 * maps.size() * maps.size()));
    for (std::size_t i = 0; i < lights.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(sample(filled, maps.size(), lights[i], 3, c), values[3 * i + c], 1e-5f) << lights.size();
  }
}

// Thin plates and bilinear samples have them; but texels beyond the hull, which keep its values,
// are read near it, and what that costs at a light is spread around it.
TEST(LightMaps, ReproduceLinearFunctionsWithinTheHull) {
  const std::vector<glm::vec3> lights = ubo2003();
  const auto value = [](glm::vec3 light) { return 2.0f + glm::dot(disc(light), glm::vec2(0.7f, -0.4f)); };
  std::vector<float> values;
  for (glm::vec3 light : lights) values.push_back(value(light));
  const LightMaps maps(lights);
  const std::vector<float> map = maps.filled(values, 1);
  for (double theta = 0.0; theta < 60.0; theta += 7.0)
    for (double phi = 0.0; phi < 360.0; phi += 11.0) {
      const glm::vec3 light = directionFromDegrees(theta, phi);
      EXPECT_NEAR(sample(map, maps.size(), light), value(light), 5e-3f) << theta << ' ' << phi;
    }
}

TEST(LightMaps, FollowSmoothFunctionsBetweenLights) {
  const std::vector<glm::vec3> lights = ubo2003();
  const auto value = [](glm::vec3 light) { return std::exp(2.0f * light.x + light.y * light.z); };
  std::vector<float> values;
  for (glm::vec3 light : lights) values.push_back(value(light));
  const LightMaps maps(lights);
  const std::vector<float> map = maps.filled(values, 1);
  for (double theta = 0.0; theta < 72.0; theta += 7.0)
    for (double phi = 0.0; phi < 360.0; phi += 11.0) {
      const glm::vec3 light = directionFromDegrees(theta, phi);
      EXPECT_NEAR(sample(map, maps.size(), light) / value(light), 1.0f, 0.06f) << theta << ' ' << phi;
    }
}

TEST(LightMaps, KeepTheValuesOfTheHullBeyondIt) {
  const std::vector<glm::vec3> lights = ubo2003();
  std::vector<float> values;
  for (glm::vec3 light : lights) values.push_back(light.z);
  const LightMaps maps(lights);
  const std::vector<float> map = maps.filled(values, 1);
  for (double phi = 0.0; phi < 360.0; phi += 15.0)
    EXPECT_NEAR(sample(map, maps.size(), directionFromDegrees(88.0, phi)), lights.back().z, 0.05f);
}

TEST(LightMaps, OneLightGivesAConstant) {
  for (float value : LightMaps(rings({{35, 1}})).filled(std::vector{0.25f}, 1))
    EXPECT_NEAR(value, 0.25f, 1e-6f);
}

TEST(LightMaps, LightsOnALineDoNotOvershoot) {
  for (const auto& lights : {rings({{20, 2}}), rings({{0, 1}, {50, 2}})}) {
    std::vector<float> values(lights.size(), 0.0f);
    values.front() = 1.0f;
    for (float value : LightMaps(lights).filled(values, 1)) {
      EXPECT_GT(value, -0.3f);
      EXPECT_LT(value, 1.3f);
    }
  }
}

// Lights that were moved by hand may be anywhere.
TEST(LightMaps, LightsSideBySideDoNotOvershoot) {
  std::vector<glm::vec3> lights = ubo2003();
  lights.push_back(directionFromDegrees(45.2, 0.0));
  std::vector<float> values(lights.size(), 0.5f);
  values.back() = 0.6f;
  for (float value : LightMaps(lights).filled(values, 1)) {
    EXPECT_GT(value, 0.2f);
    EXPECT_LT(value, 0.9f);
  }
}

}  // namespace
}  // namespace weft
