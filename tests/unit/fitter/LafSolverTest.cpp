#include "weft/fitter/LafSolver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "LafTexels.h"

namespace weft {
namespace {

using test::lafCost;
using test::LafTexels;
using test::lafValue;
using test::syntheticLafTexels;

// A part of UBO2003's directions, so that the reference does not take minutes.
std::vector<glm::vec3> fewDirections() {
  std::vector<glm::vec3> directions;
  for (const glm::vec3 direction : test::ubo2003Sampling())
    if (const double theta = degreesFromDirection(direction).x;
        std::abs(theta - 15.0) > 1.0 && std::abs(theta - 45.0) > 1.0 && theta < 70.0)
      directions.push_back(direction);
  return directions;
}

TEST(LafSolver, RecoversKnownLobes) {
  const LafTexels texels = syntheticLafTexels(20, 0.0f, test::ubo2003Sampling());
  const LafSolver solver(texels.problem);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    LafFit fit = solver.fit(texels.job(i), 2);
    solver.improve(texels.job(i), 100, fit);
    const LafFit& truth = texels.truths[i];
    EXPECT_NEAR(fit.diffuse, truth.diffuse, 2e-3) << i;
    ASSERT_EQ(fit.lobes.size(), 2u);
    if (fit.lobes[0].axes.x < fit.lobes[1].axes.x) std::swap(fit.lobes[0], fit.lobes[1]);
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(fit.lobes[j].amplitude, truth.lobes[j].amplitude, 0.03 * truth.lobes[j].amplitude) << i;
      EXPECT_NEAR(fit.lobes[j].exponent, truth.lobes[j].exponent, 0.03 * truth.lobes[j].exponent) << i;
      EXPECT_LT(glm::distance(fit.lobes[j].axes, truth.lobes[j].axes), 0.02f) << i;
    }
  }
}

TEST(LafSolver, FindsWhatCeresFinds) {
  const LafTexels texels = syntheticLafTexels(100, 0.1f, fewDirections());
  const LafSolver solver(texels.problem);
  double sum = 0.0;
  double referenceSum = 0.0;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    LafFit fit = texels.starts[i];
    solver.improve(texels.job(i), 50, fit);
    const double reference = test::lafCostByReference(texels.problem, texels.job(i), texels.starts[i], 50);
    sum += std::sqrt(fit.cost);
    referenceSum += std::sqrt(reference);
    ratios.push_back(std::sqrt(fit.cost / reference));
  }
  std::ranges::sort(ratios);
  EXPECT_LT(sum / referenceSum, 1.01);
  EXPECT_LT(ratios[ratios.size() * 99 / 100], 1.1);
}

// Its own starts find at least what a start beside the truth leads to.
TEST(LafSolver, NeedsNoStart) {
  const LafTexels texels = syntheticLafTexels(50, 0.1f, test::ubo2003Sampling());
  const LafSolver solver(texels.problem);
  double sum = 0.0;
  double knowing = 0.0;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    LafFit fit = texels.starts[i];
    solver.improve(texels.job(i), 50, fit);
    knowing += std::sqrt(fit.cost);
    sum += std::sqrt(solver.fit(texels.job(i), 2).cost);
  }
  EXPECT_LT(sum, 1.002 * knowing);
}

TEST(LafSolver, TheCostIsThatOfEverySample) {
  const LafTexels texels = syntheticLafTexels(5, 0.1f, fewDirections());
  const LafSolver solver(texels.problem);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const LafFit fit = solver.fit(texels.job(i), 3);
    EXPECT_NEAR(fit.cost, lafCost(texels.problem, texels.job(i), fit), 1e-3 * fit.cost);
    const std::vector<float> values = solver.values(fit);
    for (std::size_t pair = 0; pair < values.size(); pair += 7) {
      const std::size_t lights = texels.problem.lights.size();
      EXPECT_NEAR(values[pair],
                  lafValue(fit, texels.problem.lights[pair % lights], texels.problem.views[pair / lights]),
                  1e-4);
    }
  }
}

TEST(LafSolver, MoreLobesFitBetter) {
  const LafTexels texels = syntheticLafTexels(5, 0.1f, test::ubo2003Sampling());
  const LafSolver solver(texels.problem);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    double before = solver.fit(texels.job(i), 1).cost;
    for (const int lobes : {2, 4, 10}) {
      const LafFit fit = solver.fit(texels.job(i), lobes);
      EXPECT_EQ(fit.lobes.size(), static_cast<std::size_t>(lobes));
      EXPECT_LT(fit.cost, 1.0001 * before);
      before = fit.cost;
    }
  }
}

TEST(LafSolver, PairsThatNoLobeTellsApartAreOne) {
  const std::vector<glm::vec3> ubo = test::ubo2003Sampling();
  const LafSolver solver({ubo, ubo});
  EXPECT_EQ(solver.groups().size(), 6561u);
  EXPECT_EQ(solver.groupCount(), 837u);
  const std::span<const std::uint32_t> groups = solver.groups();
  for (std::size_t v = 0; v < 81; ++v)
    for (std::size_t l = 0; l < v; ++l) EXPECT_EQ(groups[v * 81 + l], groups[l * 81 + v]);
}

// Noise of 100 % and ten lobes to chase it: values between the samples stay below the ceilings all
// the same.
TEST(LafSolver, LimitedFitsHaveNoWhitePixels) {
  LafTexels texels = syntheticLafTexels(10, 1.0f, test::ubo2003Sampling());
  const LafSolver solver(texels.problem);
  const std::size_t lights = texels.problem.lights.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    std::vector<float> brightest(texels.problem.views.size());
    for (std::size_t pair = 0; pair < texels.targets[i].size(); ++pair) {
      const float weight = texels.scales[i][pair] / texels.problem.lights[pair % lights].z;
      float& most = brightest[pair / lights];
      most = std::max(most, texels.targets[i][pair] / weight);
    }
    // Some views see next to nothing.
    for (std::size_t v = 0; v < brightest.size(); v += 7) brightest[v] *= 0.3f;
    LafFit fit = solver.fit(texels.job(i), 10);
    const double before = fit.cost;
    solver.limit(texels.job(i), brightest, fit);
    EXPECT_LT(fit.cost, 2.0 * before) << i;
    for (int k = 0; k < 20000; ++k) {
      const float z = unit(random);
      const float phi = 6.2831853f * unit(random);
      const float across = std::sqrt(1.0f - z * z);
      const glm::vec3 light(across * std::cos(phi), across * std::sin(phi), z);
      const std::size_t view = static_cast<std::size_t>(k) % brightest.size();
      ASSERT_LT(light.z * lafValue(fit, light, texels.problem.views[view]), 1.12 * brightest[view])
          << "texel " << i << ", view " << view << ", light z " << z;
    }
  }
}

TEST(LafSolver, BlackUnknownAndHugeTexelsStayFinite) {
  const std::vector<glm::vec3> ubo = test::ubo2003Sampling();
  const LafSolver solver({ubo, ubo});
  for (const auto& [target, scale] :
       {std::pair(0.0f, 1.0f), {0.0f, 0.0f}, {0.5f, 1.0f}, {1e6f, 1.0f}, {1e30f, 1.0f}, {1e-30f, 1e-20f}}) {
    const std::vector<float> targets(6561, target);
    const std::vector<float> scales(6561, scale);
    LafFit fit = solver.fit({targets, scales}, 4);
    solver.limit({targets, scales}, std::vector<float>(81, target), fit);
    ASSERT_EQ(fit.lobes.size(), 4u);
    EXPECT_TRUE(std::isfinite(fit.diffuse)) << target;
    for (const LafLobe& lobe : fit.lobes) {
      EXPECT_TRUE(std::isfinite(lobe.amplitude + lobe.axes.x + lobe.axes.y + lobe.axes.z)) << target;
      EXPECT_TRUE(lobe.exponent >= 1.0f && lobe.exponent <= 80.0f);
    }
    if (target == 0.5f) {
      EXPECT_LT(fit.cost, 200.0);
    }
  }
}

TEST(LafSolver, OneViewAlone) {
  const std::vector<glm::vec3> lights = test::ubo2003Sampling();
  const glm::vec3 view = directionFromDegrees(50.0, 0.0);
  const LafSolver solver({{view}, lights});
  const LafFit truth{0.1f, {{0.5f, {-1.0f, -1.0f, 1.0f}, 12.0f}}};
  std::vector<float> targets;
  std::vector<float> scales;
  for (const glm::vec3 light : lights) {
    targets.push_back(light.z * static_cast<float>(lafValue(truth, light, view)));
    scales.push_back(light.z);
  }
  EXPECT_LT(solver.fit({targets, scales}, 2).cost, 1e-3);
}

}  // namespace
}  // namespace weft
