#include "weft/reflectance/CosineLobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace weft::test {
namespace {

// The lobe's integral, mean direction and spread by sums over directions that are spread as the
// lobe.
CosineLobe integrated(glm::vec3 t, float exponent, glm::vec3 normal) {
  constexpr int kSteps = 200;
  const glm::vec3 x = glm::normalize(normal - glm::dot(normal, t) * t);
  glm::dvec3 sum(0.0);
  double whole = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double up = std::pow((i + 0.5) / kSteps, 1.0 / (exponent + 1.0));
    for (int j = 0; j < kSteps; ++j) {
      const double across = std::sqrt(1.0 - up * up) * std::cos(std::numbers::pi * (j + 0.5) / kSteps);
      const double facing = across * glm::dot(normal, x) + up * glm::dot(normal, t);
      if (facing <= 0.0) continue;
      whole += facing;
      sum += facing * (across * glm::dvec3(x) + up * glm::dvec3(t));
    }
  }
  return {static_cast<float>(2.0 / (exponent + 1.0) * whole / (kSteps * kSteps)),
          glm::vec3(glm::normalize(sum)), static_cast<float>(1.0 / (1.0 - glm::length(sum) / whole) - 2.0)};
}

TEST(CosineLobe, IsNearlyTheIntegralAboveTheHorizon) {
  const glm::vec3 normal(0, 0, 1);
  for (const float exponent : {1.0f, 2.0f, 5.0f, 20.0f, 80.0f})
    for (const float angle : {0.02f, 0.5f, 0.9f, 1.2f, 1.4f, 1.5f, 1.57f, 1.65f}) {
      SCOPED_TRACE(testing::Message() << "exponent " << exponent << ", angle " << angle);
      const glm::vec3 t(std::sin(angle) * 0.6f, std::sin(angle) * 0.8f, std::cos(angle));
      const CosineLobe expected = integrated(t, exponent, normal);
      const CosineLobe actual = lobeAboveHorizon(t, exponent, normal);
      // Of a whole lobe 2 / (n + 1).
      EXPECT_NEAR(actual.amount, expected.amount,
                  0.035f * expected.amount + 0.002f * 2.0f / (exponent + 1.0f));
      if (expected.amount * (exponent + 1.0f) < 0.04f) continue;  // next to nothing is left
      EXPECT_NEAR(glm::length(actual.direction), 1.0f, 1e-5f);
      // In parts of the lobe's own width.
      EXPECT_LE(
          std::acos(std::min(glm::dot(actual.direction, expected.direction), 1.0f)) * std::sqrt(exponent),
          0.3f);
      EXPECT_NEAR(std::log2(actual.exponent), std::log2(expected.exponent), 0.36f);
    }
}

// Nothing that a file may hold makes a number that is none.
TEST(CosineLobe, IsFiniteEverywhere) {
  for (const float exponent : {1.0f, 3.7f, 81.0f, 1000.0f})
    for (int i = -100; i <= 100; ++i) {
      const float z = static_cast<float>(i) / 100.0f;
      const CosineLobe lobe = lobeAboveHorizon({std::sqrt(1.0f - z * z), 0, z}, exponent, {0, 0, 1});
      EXPECT_TRUE(std::isfinite(lobe.amount) && lobe.amount >= 0.0f && std::isfinite(lobe.direction.x) &&
                  lobe.exponent >= 1.0f && lobe.exponent < 8.0f * exponent + 8.0f)
          << exponent << " " << z << " " << lobe.amount << " " << lobe.exponent;
    }
}

}  // namespace
}  // namespace weft::test
