#include "weft/core/Direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace weft {
namespace {

void expectNear(glm::vec3 actual, glm::vec3 expected, float tolerance = 1e-6f) {
  EXPECT_LT(glm::length(actual - expected), tolerance)
      << actual.x << ' ' << actual.y << ' ' << actual.z << " instead of " << expected.x << ' ' << expected.y
      << ' ' << expected.z;
}

TEST(Direction, XIsRightYIsUpZIsTheNormal) {
  expectNear(directionFromDegrees(0, 0), {0, 0, 1});
  expectNear(directionFromDegrees(90, 0), {1, 0, 0});
  expectNear(directionFromDegrees(90, 90), {0, 1, 0});
  expectNear(directionFromDegrees(90, 180), {-1, 0, 0});
  expectNear(directionFromDegrees(60, 270), {0, -std::sqrt(3.0f) / 2.0f, 0.5f});
}

TEST(Direction, DegreesRoundTrip) {
  for (double theta = 0.5; theta < 180.0; theta += 7.3)
    for (double phi = 0.0; phi < 360.0; phi += 11.9) {
      const glm::dvec2 degrees = degreesFromDirection(directionFromDegrees(theta, phi));
      EXPECT_NEAR(degrees.x, theta, 1e-3);
      EXPECT_NEAR(std::remainder(degrees.y - phi, 360.0), 0.0, 1e-3);
      EXPECT_GE(degrees.y, 0.0);
      EXPECT_LT(degrees.y, 360.0);
    }
  EXPECT_EQ(degreesFromDirection({0, 0, 1}), glm::dvec2(0, 0));
}

TEST(Parabolic, RoundTripsOverTheSphere) {
  for (double theta = 0.0; theta < 170.0; theta += 3.1)
    for (double phi = 0.0; phi < 360.0; phi += 7.7) {
      const glm::vec3 direction = directionFromDegrees(theta, phi);
      expectNear(directionFromParabolic(parabolicFromDirection(direction)), direction, 2e-5f);
    }
}

TEST(Parabolic, IsTheHalfAnglesTangent) {
  for (double theta = 0.0; theta <= 90.0; theta += 2.5)
    EXPECT_NEAR(glm::length(parabolicFromDirection(directionFromDegrees(theta, 40))),
                std::tan(theta * std::acos(-1.0) / 360.0), 1e-6);
}

TEST(Parabolic, GivesUnitVectorsForThePlane) {
  for (float x = -30.0f; x <= 30.0f; x += 0.7f)
    for (float y = -30.0f; y <= 30.0f; y += 1.3f)
      EXPECT_NEAR(glm::length(directionFromParabolic({x, y})), 1.0f, 1e-6f);
}

TEST(Direction, TheNearestIsTheOneAtTheSmallestAngle) {
  const std::vector<glm::vec3> directions{directionFromDegrees(0, 0), directionFromDegrees(30, 0),
                                          directionFromDegrees(30, 180), directionFromDegrees(60, 0)};
  EXPECT_EQ(nearestDirection(directions, directionFromDegrees(14, 0)), 0u);
  EXPECT_EQ(nearestDirection(directions, directionFromDegrees(25, 350)), 1u);
  EXPECT_EQ(nearestDirection(directions, directionFromDegrees(25, 170)), 2u);
  EXPECT_EQ(nearestDirection(directions, directionFromDegrees(80, 10)), 3u);
}

}  // namespace
}  // namespace weft
