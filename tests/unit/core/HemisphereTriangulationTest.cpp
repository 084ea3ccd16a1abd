#include "weft/core/HemisphereTriangulation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "TestSupport.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

using test::valueOf;
using testing::HasSubstr;

std::vector<glm::vec3> rings(const std::vector<std::pair<double, int>>& thetaAndCount) {
  std::vector<glm::vec3> directions;
  for (const auto& [theta, count] : thetaAndCount)
    for (int i = 0; i < count; ++i) directions.push_back(directionFromDegrees(theta, 360.0 * i / count));
  return directions;
}

// UBO2003's directions; the last 24 are the lowest ring, at 75 degrees.
std::vector<glm::vec3> ubo2003() {
  return rings({{0, 1}, {15, 6}, {30, 12}, {45, 18}, {60, 20}, {75, 24}});
}
constexpr int kLowestRing = 57;
constexpr double kLowestTheta = 75.0;

std::vector<glm::vec3> randomDirections(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::vec3> directions;
  for (int i = 0; i < count; ++i)
    directions.push_back(directionFromDegrees(90.0 * std::sqrt(unit(random)), 360.0 * unit(random)));
  return directions;
}

std::vector<std::vector<glm::vec3>> allSets() {
  return {
      ubo2003(),
      rings({{0, 1}, {11, 6}, {23.5, 12}, {30, 12}, {37.5, 12}, {45, 18}, {52.5, 18}, {60, 24}, {90, 24}}),
      rings({{40, 3}}), rings({{0, 1}, {80, 5}}), randomDirections(100)};
}

glm::dvec2 pointOf(glm::vec3 direction) {
  return glm::dvec2(direction.x, direction.y) / (1.0 + static_cast<double>(direction.z));
}

glm::vec2 interpolatedPoint(const DirectionWeights& weights, const std::vector<glm::vec3>& directions) {
  glm::vec2 sum(0.0f);
  for (int k = 0; k < 3; ++k)
    sum += weights.weight[k] *
           parabolicFromDirection(
               directions[static_cast<std::size_t>(weights.index[static_cast<std::size_t>(k)])]);
  return sum;
}

double doubleArea(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::vector<glm::vec3> queries() {
  std::vector<glm::vec3> directions = randomDirections(500);
  for (double theta : {0.0, 14.9, 15.0, 74.9, 75.0, 75.1, 89.0, 90.0, 91.0, 120.0, 179.0})
    for (double phi = 0.0; phi < 360.0; phi += 3.7) directions.push_back(directionFromDegrees(theta, phi));
  return directions;
}

TEST(HemisphereTriangulation, WeightsAreAPartitionOfOne) {
  for (const std::vector<glm::vec3>& set : allSets()) {
    const auto triangulation = valueOf(HemisphereTriangulation::create(set));
    for (glm::vec3 query : queries()) {
      const DirectionWeights weights = triangulation.locate(query);
      EXPECT_NEAR(weights.weight.x + weights.weight.y + weights.weight.z, 1.0f, 1e-6f);
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(weights.weight[k], 0.0f);
        EXPECT_GE(weights.index[static_cast<std::size_t>(k)], 0);
        EXPECT_LT(weights.index[static_cast<std::size_t>(k)], static_cast<int>(set.size()));
      }
    }
  }
}

TEST(HemisphereTriangulation, ReproducesLinearFunctionsInsideOfTheHull) {
  const std::vector<glm::vec3> set = ubo2003();
  const auto triangulation = valueOf(HemisphereTriangulation::create(set));
  // The lowest ring is a 24-gon; this is the radius of the circle in it.
  const double inside = std::tan(std::numbers::pi * kLowestTheta / 360.0) * std::cos(std::numbers::pi / 24.0);
  int tested = 0;
  for (glm::vec3 query : queries()) {
    const glm::vec2 p = parabolicFromDirection(query);
    if (query.z <= 0.0f || static_cast<double>(glm::length(p)) > inside) continue;
    const glm::vec2 reproduced = interpolatedPoint(triangulation.locate(query), set);
    EXPECT_LT(glm::distance(reproduced, p), 2e-6f) << p.x << ' ' << p.y;
    ++tested;
  }
  EXPECT_GT(tested, 300);
}

TEST(HemisphereTriangulation, NoDirectionLiesInACircumcircle) {
  for (const std::vector<glm::vec3>& set : allSets()) {
    const auto triangulation = valueOf(HemisphereTriangulation::create(set));
    for (const auto& triangle : triangulation.triangles()) {
      std::array<glm::dvec2, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = pointOf(set[static_cast<std::size_t>(triangle.corner[k])]);
      const double area = doubleArea(p[0], p[1], p[2]);
      ASSERT_GT(area, 0.0) << "counter-clockwise";
      // Circumcentre relative to p[0].
      const glm::dvec2 b = p[1] - p[0];
      const glm::dvec2 c = p[2] - p[0];
      const glm::dvec2 centre = glm::dvec2(c.y * glm::dot(b, b) - b.y * glm::dot(c, c),
                                           b.x * glm::dot(c, c) - c.x * glm::dot(b, b)) /
                                (2.0 * area);
      const double radius = glm::length(centre);
      // three points almost on a line: nothing to test against in doubles
      if (radius > 1e3) continue;
      for (glm::vec3 other : set)
        EXPECT_GT(glm::distance(pointOf(other), p[0] + centre), radius * (1.0 - 1e-4)) << "ties are allowed";
    }
  }
}

TEST(HemisphereTriangulation, TrianglesFillTheHullOnce) {
  const auto triangulation = valueOf(HemisphereTriangulation::create(ubo2003()));
  const std::vector<glm::vec3> set = ubo2003();
  double area = 0.0;
  int hullEdges = 0;
  for (const auto& triangle : triangulation.triangles()) {
    area += 0.5 * doubleArea(pointOf(set[static_cast<std::size_t>(triangle.corner[0])]),
                             pointOf(set[static_cast<std::size_t>(triangle.corner[1])]),
                             pointOf(set[static_cast<std::size_t>(triangle.corner[2])]));
    hullEdges += static_cast<int>(std::count(triangle.hullEdge.begin(), triangle.hullEdge.end(), true));
  }
  const double radius = std::tan(std::numbers::pi * kLowestTheta / 360.0);
  EXPECT_NEAR(area, 12.0 * radius * radius * std::sin(std::numbers::pi / 12.0), 1e-6);
  EXPECT_EQ(hullEdges, 24);
  EXPECT_EQ(triangulation.triangles().size(), 2u * 81 - 2 - 24);  // Euler's formula
}

TEST(HemisphereTriangulation, AMeasuredDirectionStandsForItself) {
  for (const std::vector<glm::vec3>& set : allSets()) {
    const auto triangulation = valueOf(HemisphereTriangulation::create(set));
    for (std::size_t i = 0; i < set.size(); ++i) {
      const DirectionWeights weights = triangulation.locate(set[i]);
      EXPECT_EQ(weights.nearest(), static_cast<int>(i));
      EXPECT_GT(std::max({weights.weight.x, weights.weight.y, weights.weight.z}), 0.9999f);
    }
  }
}

TEST(HemisphereTriangulation, BelowTheLowestRingOnlyTheTwoNeighboursCount) {
  const auto triangulation = valueOf(HemisphereTriangulation::create(ubo2003()));
  for (double theta : {75.5, 80.0, 89.9, 90.0, 95.0, 140.0})
    for (double phi = 0.05; phi < 360.0; phi += 0.35) {
      const DirectionWeights weights = triangulation.locate(directionFromDegrees(theta, phi));
      const int before = kLowestRing + static_cast<int>(phi / 15.0);
      const int after = before == 80 ? kLowestRing : before + 1;
      float total = 0.0f;
      for (std::size_t k = 0; k < 3; ++k)
        if (weights.index[k] == before || weights.index[k] == after)
          total += weights.weight[static_cast<int>(k)];
      ASSERT_NEAR(total, 1.0f, 2e-5f) << theta << ' ' << phi;
    }
}

// The value at every direction is that of a bumpy function; a jump between triangles would show as
// a step.
TEST(HemisphereTriangulation, InterpolatesContinuously) {
  const std::vector<glm::vec3> set = ubo2003();
  const auto triangulation = valueOf(HemisphereTriangulation::create(set));
  const auto valueAt = [&](glm::vec3 direction) {
    const DirectionWeights weights = triangulation.locate(direction);
    float sum = 0.0f;
    for (std::size_t k = 0; k < 3; ++k)
      sum += weights.weight[static_cast<int>(k)] * std::sin(37.0f * static_cast<float>(weights.index[k]));
    return sum;
  };
  constexpr double step = 0.01;
  for (double theta : {3.0, 15.0, 29.0, 45.0, 66.0, 74.5, 75.0, 76.0, 85.0, 90.0, 130.0})
    for (double phi = 0.0; phi < 62.0; phi += step)  // two of the innermost ring's triangles
      ASSERT_NEAR(valueAt(directionFromDegrees(theta, phi)), valueAt(directionFromDegrees(theta, phi + step)),
                  0.01f)
          << theta << ' ' << phi;
  for (double phi : {0.0, 7.5, 11.0, 200.0, 355.0})
    for (double theta = 0.0; theta < 95.0; theta += step)
      ASSERT_NEAR(valueAt(directionFromDegrees(theta, phi)), valueAt(directionFromDegrees(theta + step, phi)),
                  0.01f)
          << theta << ' ' << phi;
}

TEST(HemisphereTriangulation, LiftsDirectionsToTheHorizonAndIgnoresLength) {
  const auto triangulation = valueOf(HemisphereTriangulation::create(ubo2003()));
  const glm::vec3 horizon = directionFromDegrees(90, 33);
  const DirectionWeights expected = triangulation.locate(horizon);
  for (glm::vec3 query :
       {5.0f * horizon, horizon - glm::vec3(0, 0, 0.7f), horizon - glm::vec3(0, 0, 90.0f)}) {
    const DirectionWeights weights = triangulation.locate(query);
    EXPECT_EQ(weights.index, expected.index);
    EXPECT_LT(glm::distance(weights.weight, expected.weight), 1e-5f);
  }
  EXPECT_EQ(parabolicAboveHorizon({0, 0, 0}), glm::vec2(0.0f));
  EXPECT_EQ(triangulation.locate({0, 0, -1}).nearest(), 0);
}

TEST(HemisphereTriangulation, OneDirectionCountsEverywhere) {
  const auto triangulation =
      valueOf(HemisphereTriangulation::create(std::vector{directionFromDegrees(30, 70)}));
  for (glm::vec3 query : queries()) {
    const DirectionWeights weights = triangulation.locate(query);
    EXPECT_EQ(weights.nearest(), 0);
    EXPECT_EQ(weights.weight, glm::vec3(1, 0, 0));
  }
}

TEST(HemisphereTriangulation, EqualInputGivesEqualTriangles) {
  const auto first = valueOf(HemisphereTriangulation::create(ubo2003()));
  const auto second = valueOf(HemisphereTriangulation::create(ubo2003()));
  ASSERT_EQ(first.triangles().size(), second.triangles().size());
  for (std::size_t i = 0; i < first.triangles().size(); ++i) {
    EXPECT_EQ(first.triangles()[i].corner, second.triangles()[i].corner);
    EXPECT_EQ(first.triangles()[i].weightRows, second.triangles()[i].weightRows);
  }
}

TEST(HemisphereTriangulation, RefusesImpossibleSets) {
  const auto errorOf = [](const std::vector<glm::vec3>& set) {
    const auto result = HemisphereTriangulation::create(set);
    return result ? std::string("created") : result.error().message();
  };
  EXPECT_THAT(errorOf({}), HasSubstr("no directions"));
  EXPECT_THAT(errorOf({{0, 0, 1}, {0, 0, 1}}), HasSubstr("occurs twice"));
  EXPECT_THAT(errorOf({{0, 0, 1}, {0.6f, 0, 0.8f}}), HasSubstr("on one line"));
  EXPECT_THAT(errorOf({{-0.6f, 0, 0.8f}, {0, 0, 1}, {0.6f, 0, 0.8f}, {1, 0, 0}}), HasSubstr("on one line"));
  EXPECT_THAT(errorOf({{0, 0, 2}}), HasSubstr("not a unit vector"));
  EXPECT_THAT(errorOf({{0.6f, 0, -0.8f}}), HasSubstr("not a unit vector"));
  EXPECT_THAT(errorOf({{std::nanf(""), 0, 1}}), HasSubstr("not a unit vector"));
}

}  // namespace
}  // namespace weft
