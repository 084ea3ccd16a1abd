#include "weft/reflectance/Environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "TestSupport.h"
#include "weft/reflectance/OctahedralMap.h"

namespace weft::test {
namespace {

TEST(Environment, TheMiddleLiesAheadAndTheTopAbove) {
  const auto expectDirection = [](glm::vec2 place, glm::vec3 direction) {
    EXPECT_LE(glm::distance(Environment::direction(place), direction), 1e-6f);
    EXPECT_LE(glm::distance(Environment::direction(Environment::place(direction)), direction), 1e-5f);
  };
  expectDirection({0.5f, 0.5f}, {0, 0, -1});
  expectDirection({0.75f, 0.5f}, {1, 0, 0});
  expectDirection({0.5f, 0.0f}, {0, 1, 0});
  expectDirection({0.625f, 0.25f}, {0.5f, std::numbers::sqrt2_v<float> / 2, -0.5f});
}

TEST(Environment, TexelsCoverTheSphere) {
  const Environment environment = valueOf(Environment::builtin("sky"));
  double sum = 0.0;
  for (int y = 0; y < environment.height(); ++y) sum += environment.width() * environment.solidAngle(y);
  EXPECT_NEAR(sum, 4.0 * std::numbers::pi, 1e-9);
}

glm::dvec3 power(const Environment& environment) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < environment.height(); ++y)
    for (int x = 0; x < environment.width(); ++x)
      sum += environment.solidAngle(y) * glm::dvec3(environment.texel(x, y));
  return sum;
}

TEST(Environment, SmallerOnesGiveTheSameLight) {
  const Environment environment = valueOf(Environment::builtin("sky"));
  for (const glm::ivec2 size : {glm::ivec2(512, 256), {100, 37}, {2, 1}}) {
    const Environment smaller = environment.reduced(size.x, size.y);
    EXPECT_EQ(smaller.width(), size.x);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(power(smaller)[c] / power(environment)[c], 1.0, 1e-5);
  }
  EXPECT_EQ(environment.reduced(4096, 4096).width(), environment.width());
}

TEST(Environment, ChannelsAreTakenByName) {
  FloatImage image(2, 1, {"A", "B", "G", "R"});
  for (int c = 0; c < 4; ++c) image.at(1, 0, c) = static_cast<float>(c);
  std::vector<std::string> warnings;
  EXPECT_EQ(valueOf(Environment::create(image, warnings)).texel(1, 0), glm::vec3(3, 2, 1));
  EXPECT_EQ(valueOf(Environment::create(FloatImage(2, 1, {"Y"}), warnings)).texel(0, 0), glm::vec3(0));
  EXPECT_FALSE(Environment::create(FloatImage(2, 1, {"X", "Y"}), warnings));
  EXPECT_FALSE(Environment::builtin("cellar"));
}

TEST(OctahedralMap, DirectionsAndPlacesAreInverse) {
  const OctahedralMap map{16};
  for (int y = 0; y < map.size; ++y)
    for (int x = 0; x < map.size; ++x) {
      const glm::vec2 place = OctahedralMap::place(3.0f * map.direction(x, y));
      EXPECT_NEAR(place.x, (2.0f * static_cast<float>(x) + 1.0f) / 16.0f - 1.0f, 1e-5f);
      EXPECT_NEAR(place.y, (2.0f * static_cast<float>(y) + 1.0f) / 16.0f - 1.0f, 1e-5f);
    }
}

// A bilinear fetch across an edge mixes what lies beside it on the sphere.
TEST(OctahedralMap, TheBorderRepeatsTheNeighbours) {
  const OctahedralMap map{16};
  for (int i = 0; i < map.size; ++i)
    for (const auto& [outside, inside] : {std::pair(glm::ivec2(0, i + 1), glm::ivec2(0, i)),
                                          std::pair(glm::ivec2(17, i + 1), glm::ivec2(15, i)),
                                          std::pair(glm::ivec2(i + 1, 0), glm::ivec2(i, 0)),
                                          std::pair(glm::ivec2(i + 1, 17), glm::ivec2(i, 15))}) {
      const glm::ivec2 source = map.source(outside.x, outside.y);
      EXPECT_GE(glm::dot(map.direction(source.x, source.y), map.direction(inside.x, inside.y)), 0.95f);
    }
}

}  // namespace
}  // namespace weft::test
