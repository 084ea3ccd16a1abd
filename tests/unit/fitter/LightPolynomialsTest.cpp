#include "solvers/LightPolynomials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "weft/reflectance/LightMap.h"

namespace weft {
namespace {

constexpr int kSize = 24;

// A map of what `of` gives for the light of each texel's centre; beyond the disc for its edge.
template <class Function>
std::vector<float> mapOf(Function of) {
  std::vector<float> map;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      glm::dvec2 disc = 2.0 * glm::dvec2(x, y) / (kSize - 1.0) - 1.0;
      if (glm::length(disc) > 1.0) disc = glm::normalize(disc);
      const double squared = glm::dot(disc, disc);
      map.push_back(static_cast<float>(of(glm::dvec3(disc * std::sqrt(2.0 - squared), 1.0 - squared))));
    }
  return map;
}

TEST(LightPolynomials, APolynomialIsItself) {
  const auto map = mapOf([](glm::dvec3 l) {
    return 0.4 * l.x * l.x - 0.3 * l.y * l.y + 0.2 * l.x * l.y - 0.1 * l.x + 0.5 * l.y + 0.7;
  });
  const std::vector<float> found = lightPolynomials(map, kSize, 1, 1, 1);
  const float expected[] = {0.4f, -0.3f, 0.2f, -0.1f, 0.5f, 0.7f};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], 0.01f) << i;
}

// The constant of a linear one is chosen so that the light of an even sky is right.
TEST(LightPolynomials, ALinearOneKeepsTheIntegral) {
  const auto map = mapOf([](glm::dvec3 l) { return 1.0 + l.x * l.x; });
  const std::vector<float> found = lightPolynomials(map, kSize, 1, 0, 1);
  EXPECT_EQ(found[0], 0.0f);
  EXPECT_NEAR(found[3], 0.0f, 1e-4f);
  EXPECT_NEAR(found[5], 1.25f, 0.01f);  // the mean of xx under the cosine is 1/4
}

}  // namespace
}  // namespace weft
