#include "weft/evaluation/RawBtf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "MemoryBtf.h"
#include "Samples.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

// Nothing about it is symmetric, and it is as rough as a measurement.
glm::vec3 rough(int x, int y, glm::vec3 view, glm::vec3 light) {
  return glm::vec3(0.5f + 0.3f * std::sin(40.0f * light.x + static_cast<float>(x)),
                   0.5f + 0.2f * view.x + 0.1f * static_cast<float>(y), 0.4f + 0.3f * light.y * view.y);
}

glm::vec3 randomDirection(std::mt19937& random, double lowest, double highest) {
  std::uniform_real_distribution<double> theta(lowest, highest), phi(0.0, 360.0);
  return directionFromDegrees(theta(random), phi(random));
}

void expectNear(glm::vec3 actual, glm::vec3 expected, float tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance);
}

TEST(RawBtf, GivesTheMeasurementWhereItWasMeasured) {
  const MemoryBtf source(3, 2,
                         [](int x, int y, glm::vec3 v, glm::vec3 l) { return l.z * rough(x, y, v, l); });
  const RawBtf btf = valueOf(RawBtf::read(source));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      for (const glm::vec3 view : source.description().views)
        for (const glm::vec3 light : source.description().lights)
          expectNear(btf.evaluate(x, y, light, view), light.z * rough(x, y, view, light), 1e-4f);
}

TEST(RawBtf, InterpolatesLinearlyInTheParabolicPlane) {
  // Linear in the parabolic coordinates of view and light, so that interpolation is exact within
  // the hulls.
  const auto linear = [](int, int, glm::vec3 v, glm::vec3 l) {
    const glm::vec2 p = parabolicFromDirection(v), q = parabolicFromDirection(l);
    return glm::vec3(1.0f + p.x - 0.5f * p.y + 0.3f * q.x + 0.8f * q.y, (1 + p.x) * (2 + q.y), 2 + q.x);
  };
  std::mt19937 random(1);
  for (const bool cosine : {true, false}) {
    const MemoryBtf source(
        1, 1,
        [&](int x, int y, glm::vec3 v, glm::vec3 l) { return (cosine ? l.z : 1.0f) * linear(x, y, v, l); },
        cosine);
    const RawBtf btf = valueOf(RawBtf::read(source));
    for (int i = 0; i < 200; ++i) {
      const glm::vec3 view = randomDirection(random, 0.0, 74.0), light = randomDirection(random, 0.0, 74.0);
      expectNear(btf.evaluate(0, 0, light, view), light.z * linear(0, 0, view, light), 1e-4f);
    }
  }
}

TEST(RawBtf, AWhiteSurfaceIsWhiteBetweenAndBeyondItsDirections) {
  const MemoryBtf source(1, 1, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(l.z); });
  const RawBtf btf = valueOf(RawBtf::read(source));
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 view = randomDirection(random, 0.0, 95.0), light = randomDirection(random, 0.0, 90.0);
    expectNear(btf.evaluate(0, 0, light, view), glm::vec3(light.z), 1e-5f);
  }
  expectNear(btf.evaluate(0, 0, {0.8f, 0, -0.6f}, {0, 0, 1}), glm::vec3(0.0f), 0.0f);
}

TEST(RawBtf, BelowTheLowestLightsItFadesAtTheirAzimuth) {
  const MemoryBtf source(1, 1,
                         [](int x, int y, glm::vec3 v, glm::vec3 l) { return l.z * rough(x, y, v, l); });
  const RawBtf btf = valueOf(RawBtf::read(source));
  for (const double phi : {0.0, 45.0, 345.0}) {  // of measured lights
    const glm::vec3 ring = directionFromDegrees(75.0, phi), low = directionFromDegrees(87.0, phi);
    expectNear(btf.evaluate(0, 0, low, {0, 0, 1}), low.z * rough(0, 0, {0, 0, 1}, ring), 1e-4f);
  }
}

TEST(RawBtf, LightsOnTheHorizonAreNotDividedByTheirCosine) {
  MemoryBtf source(1, 1,
                   [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(l.z > 0.1f ? l.z : 0.01f); });
  source.description().lights = {{0, 0, 1}};
  for (int i = 0; i < 8; ++i) source.description().lights.push_back(directionFromDegrees(90.0, 45.0 * i));
  for (glm::vec3& light : source.description().lights) light.z = std::max(light.z, 0.0f);
  const RawBtf btf = valueOf(RawBtf::read(source));
  for (double theta = 0.0; theta < 90.0; theta += 5.0) {
    const float value = btf.evaluate(0, 0, directionFromDegrees(theta, 20.0), {0, 0, 1}).x;
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 1.0f);
  }
  EXPECT_NEAR(btf.evaluate(0, 0, directionFromDegrees(89.9, 45.0), {0, 0, 1}).x, 0.01f, 1e-3f);
}

TEST(RawBtf, NumbersThatAreNoneCountAsBlack) {
  const MemoryBtf source(1, 1, [](int, int, glm::vec3, glm::vec3 l) {
    return l.z == 1.0f ? glm::vec3(std::numeric_limits<float>::quiet_NaN()) : glm::vec3(l.z);
  });
  const RawBtf btf = valueOf(RawBtf::read(source));
  expectNear(btf.evaluate(0, 0, {0, 0, 1}, {0, 0, 1}), glm::vec3(0.0f), 0.0f);
  EXPECT_GT(btf.evaluate(0, 0, directionFromDegrees(7.0, 0.0), {0, 0, 1}).x, 0.2f);
}

TEST(RawBtf, IsASourceOfItsTexels) {
  const MemoryBtf source(5, 4,
                         [](int x, int y, glm::vec3 v, glm::vec3 l) { return l.z * rough(x, y, v, l); });
  const RawBtf btf = valueOf(RawBtf::read(source, Crop{2, 1, 3, 2}));
  EXPECT_EQ(btf.description().width, 3);
  EXPECT_EQ(btf.description().height, 2);
  SampleRows row;
  test::requireDone(btf.readRows(1, 1, row));
  EXPECT_EQ(row.rows(), 1);
  const SampleRows all = test::allRows(source);
  for (int x = 0; x < 3; ++x)
    for (std::size_t pair = 0; pair < all.pairs(); pair += 7)
      EXPECT_EQ(test::linearSample(row, x, 0, pair), test::linearSample(all, x + 2, 2, pair));
  EXPECT_FALSE(RawBtf::read(source, Crop{3, 0, 3, 2}));
}

TEST(RawBtf, KeepsTheBytesOfPhotographs) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_WOOL64.zip");
  const auto source = valueOf(openBtf(file));
  const RawBtf btf = valueOf(RawBtf::read(*source, Crop{10, 20, 2, 1}));
  SampleRows rows, row;
  test::requireDone(source->readRows(20, 1, rows));
  test::requireDone(btf.readRows(0, 1, row));
  for (int x = 0; x < 2; ++x)
    for (std::size_t pair = 0; pair < rows.pairs(); ++pair)
      ASSERT_EQ(test::linearSample(row, x, 0, pair), test::linearSample(rows, x + 10, 0, pair));
}

TEST(OneViewBtf, IsTheMeasurementSeenFromThere) {
  const MemoryBtf source(3, 2,
                         [](int x, int y, glm::vec3 v, glm::vec3 l) { return l.z * rough(x, y, v, l); });
  const RawBtf raw = valueOf(RawBtf::read(source));
  std::vector<glm::vec3> lights = source.description().lights;
  lights.push_back(directionFromDegrees(20.0, 77.0));
  const glm::vec3 view = source.description().views[30];
  const OneViewBtf one(raw, view, lights);
  EXPECT_EQ(one.description().views, std::vector<glm::vec3>{view});
  SampleRows row;
  test::requireDone(one.readRows(1, 1, row));
  ASSERT_EQ(row.pairs(), 82u);
  for (int x = 0; x < 3; ++x)
    for (std::size_t light = 0; light < lights.size(); ++light)
      expectNear(test::linearSample(row, x, 0, light),
                 light < 81 ? lights[light].z * rough(x, 1, view, lights[light])
                            : raw.evaluate(x, 1, lights[light], view),
                 1e-4f);
}

}  // namespace
}  // namespace weft
