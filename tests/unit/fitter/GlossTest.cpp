#include "weft/fitter/GlossChoice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "solvers/GlossLevels.h"
#include "solvers/GlossSolver.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

constexpr int kSideOfSample = 6;

GlossLobe lobeAt(int x, int y) {
  const auto wave = [](int at, float shift) { return std::sin(1.3f * static_cast<float>(at) + shift); };
  return {{0.15f * wave(x, 0.3f * static_cast<float>(y)), 0.15f * wave(y, 1.0f)},
          0.25f,
          0.05f + 0.02f * wave(x + y, 2.0f)};
}

float matteValue(int x, int y, glm::vec3 light) {
  const glm::vec3 n = glm::normalize(glm::vec3(0.1f * static_cast<float>(x % 3) - 0.1f, 0.1f, 1.0f));
  return light.z * (0.1f + (0.1f + 0.02f * static_cast<float>(y)) * std::max(glm::dot(n, light), 0.1f));
}

float value(int x, int y, glm::vec3 view, glm::vec3 light, bool shines) {
  return matteValue(x, y, light) + (shines ? light.z * lobeAt(x, y).evaluate(light, view) : 0.0f);
}

MemoryBtf surface(bool shines) {
  return MemoryBtf(kSideOfSample, kSideOfSample, [=](int x, int y, glm::vec3 v, glm::vec3 l) {
    return value(x, y, v, l, shines) * glm::vec3(1.2f, 1.0f, 0.7f);
  });
}

std::vector<float> valuesAt(int x, int y, bool shines) {
  std::vector<float> values;
  for (const glm::vec3 view : test::ubo2003Sampling())
    for (const glm::vec3 light : test::ubo2003Sampling()) values.push_back(value(x, y, view, light, shines));
  return values;
}

GlossSolver solverFor(std::span<const float> typical) {
  return valueOf(GlossSolver::create(test::ubo2003Sampling(), test::ubo2003Sampling(), typical));
}

TEST(GlossSolver, FindsALobeOverShadingAndNoneWithoutIt) {
  const GlossSolver solver = solverFor(valuesAt(0, 0, true));
  for (int i = 0; i < kSideOfSample; ++i) {
    const GlossLobe expected = lobeAt(i, 1), found = solver.solve(valuesAt(i, 1, true)).at(0);
    EXPECT_NEAR(found.tilt.x, expected.tilt.x, 0.01f);
    EXPECT_NEAR(found.tilt.y, expected.tilt.y, 0.01f);
    EXPECT_NEAR(found.alpha, expected.alpha, 0.02f);
    EXPECT_NEAR(found.amount, expected.amount, 0.1f * expected.amount);
    EXPECT_EQ(solver.solve(valuesAt(i, 1, false)).at(0).amount, 0.0f);
  }
  EXPECT_EQ(solver.solve(std::vector<float>(valuesAt(0, 0, true).size())).at(0).amount, 0.0f) << "black";
}

TEST(GlossSolver, GivesATexelTheSameAmongOthers) {
  const GlossSolver solver = solverFor(valuesAt(0, 0, true));
  std::vector<float> all;
  for (int x = 0; x < 3; ++x)
    for (const float number : valuesAt(x, 2, true)) all.push_back(number);
  const std::vector<GlossLobe> together = solver.solve(all);
  for (int x = 0; x < 3; ++x)
    EXPECT_EQ(together[static_cast<std::size_t>(x)].numbers(),
              solver.solve(valuesAt(x, 2, true)).at(0).numbers());
}

TEST(GlossSolver, AsksForDirectionsToInterpolate) {
  const std::vector<glm::vec3> few = {directionFromDegrees(0, 0), directionFromDegrees(40, 0),
                                      directionFromDegrees(40, 90)};
  EXPECT_FALSE(GlossSolver::create(few, few, std::vector<float>(9, 1.0f)));
}

FitResult fitOf(const BtfSource& source, const char* model) {
  FitOptions options;
  options.model = {model, {{"components", 8}}};
  options.holdOutLights = 8;
  options.holdOutViews = 10;
  return valueOf(fitReflectanceField(source, options));
}

double heldOutError(const FitResult& fit) {
  return fit.heldOut->of(ErrorSpace::Stored, ErrorMeasure::Luminance).average;
}

TEST(GlossFit, HasMuchSmallerErrorsBetweenMeasuredDirections) {
  const MemoryBtf shining = surface(true);
  const FitResult with = fitOf(shining, "loom_gloss");
  EXPECT_LT(heldOutError(with), 0.5 * heldOutError(fitOf(shining, "loom")));
  EXPECT_LT(heldOutError(with), 0.01);
}

TEST(GlossFit, IsRefusedWhereLightDoesNotAddUp) {
  FitOptions options;
  options.model.name = "loom_gloss";
  options.cosineInModel = true;
  const auto fit = FieldFit::create(surface(true), options);
  ASSERT_FALSE(fit);
  EXPECT_NE(fit.error().message().find("--cosine out"), std::string::npos);
}

TEST(GlossChoice, TakesALobeWhereOneShines) {
  EXPECT_TRUE(valueOf(chooseGloss(surface(true), {})).isTaken);
  const GlossChoice matte = valueOf(chooseGloss(surface(false), {}));
  EXPECT_FALSE(matte.isTaken) << matte.reason;
  MemoryBtf oneView = surface(true);
  oneView.description().views.resize(1);
  EXPECT_FALSE(valueOf(chooseGloss(oneView, {})).isTaken);
}

// Two facets that lean away from each other: wider than one, and as bright in all.
TEST(GlossLevels, AreWiderWhereNormalsDiffer) {
  const GlossLobe left{{-0.05f, 0.0f}, 0.25f, 0.04f}, right{{0.05f, 0.0f}, 0.25f, 0.04f};
  FieldLevel finest{FloatImage(2, 1, {"R", "G", "B", "a", "b", "c", "d", "W0"}), {}};
  for (int x = 0; x < 2; ++x)
    std::ranges::copy((x == 0 ? left : right).rounded().numbers(), finest.shared.texel(x, 0).begin() + 3);
  finest.shared.at(0, 0, 7) = 0.5f;
  const auto levels = glossLevels(finest, [](FieldLevel level) {
    EXPECT_EQ(level.shared.channelCount(), 4);
    EXPECT_EQ(level.shared.at(0, 0, 3), 0.5f);
    return std::vector<FieldLevel>{std::move(level), {FloatImage(1, 1, {"R", "G", "B", "W0"}), {}}};
  });
  ASSERT_EQ(levels.size(), 2u);
  const GlossLobe coarse = GlossLobe::from(levels[1].shared.texel(0, 0).subspan(3));
  EXPECT_NEAR(coarse.tilt.x, 0.0f, 0.01f);
  EXPECT_NEAR(coarse.amount, 0.04f, 0.004f);
  EXPECT_NEAR(coarse.alpha, 0.27f, 0.012f);
  for (const double theta : {0.0, 10.0, 25.0}) {
    const glm::vec3 up(0, 0, 1), light = directionFromDegrees(theta, 90);
    const float mean = 0.5f * (left.evaluate(light, up) + right.evaluate(light, up));
    EXPECT_NEAR(coarse.evaluate(light, up), mean, 0.25f * mean) << theta;
  }
}

}  // namespace
}  // namespace weft
