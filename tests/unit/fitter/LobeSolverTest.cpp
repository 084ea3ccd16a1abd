#include "weft/fitter/LobeSolver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "LobeTexels.h"

namespace weft {
namespace {

using test::LobeTexels;
using test::syntheticTexels;

TEST(LobeSolver, FindsWhatCeresFinds) {
  LobeTexels ours = syntheticTexels(2000);
  LobeTexels theirs = ours;
  std::vector<LobeJob> jobs = ours.jobs();
  std::vector<LobeJob> references = theirs.jobs();
  solveLobes(ours.problem, 2, DiffuseSolve::Solve, 50, jobs);
  for (LobeJob& job : references) test::solveByReference(theirs.problem, job, 50);

  double sum = 0.0;
  double referenceSum = 0.0;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    sum += std::sqrt(jobs[i].cost);
    referenceSum += std::sqrt(references[i].cost);
    ratios.push_back(std::sqrt(jobs[i].cost / references[i].cost));
  }
  std::ranges::sort(ratios);
  EXPECT_LT(sum / referenceSum, 1.01);
  EXPECT_LT(ratios[ratios.size() * 99 / 100], 1.1);
}

TEST(LobeSolver, TheCostIsThatOfTheParameters) {
  LobeTexels texels = syntheticTexels(100);
  std::vector<LobeJob> jobs = texels.jobs();
  solveLobes(texels.problem, 2, DiffuseSolve::Solve, 10, jobs);
  for (const LobeJob& job : jobs) {
    double p[9];
    std::vector<double> residuals(texels.problem.lights.size());
    for (int k = 0; k < 9; ++k) p[k] = job.parameters[k];
    test::ReferenceResiduals{texels.problem, job}(p, residuals.data(), nullptr);
    double cost = 0.0;
    for (double r : residuals) cost += r * r;
    EXPECT_NEAR(job.cost, cost, 2e-4 * cost + 1e-6);
  }
}

TEST(LobeSolver, AJobDoesNotDependOnTheOthers) {
  LobeTexels together = syntheticTexels(40);
  LobeTexels alone = together;
  std::vector<LobeJob> jobs = together.jobs();
  solveLobes(together.problem, 2, DiffuseSolve::Solve, 15, jobs);
  std::vector<LobeJob> single = alone.jobs();
  for (LobeJob& job : single) solveLobes(alone.problem, 2, DiffuseSolve::Solve, 15, {&job, 1});
  EXPECT_EQ(together.parameters, alone.parameters);
}

TEST(LobeSolver, AHeldAlbedoStays) {
  LobeTexels texels = syntheticTexels(20);
  const std::vector<float> before = texels.parameters;
  std::vector<LobeJob> jobs = texels.jobs();
  solveLobes(texels.problem, 2, DiffuseSolve::Hold, 10, jobs);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    EXPECT_EQ(texels.parameters[i * 9 + 8], before[i * 9 + 8]);
    EXPECT_NE(texels.parameters[i * 9], before[i * 9]);
  }
}

TEST(LobeSolver, BlackTexelsAndLostLobesStayFinite) {
  LobeTexels texels = syntheticTexels(4);
  std::fill(texels.luminance.begin(), texels.luminance.end(), 0.0f);
  for (std::size_t i = 0; i < texels.size(); ++i)
    texels.parameters[i * 9 + 1] = 50.0f;  // a lobe that points at -z
  std::vector<LobeJob> jobs = texels.jobs();
  solveLobes(texels.problem, 2, DiffuseSolve::Solve, 100, jobs);
  for (float value : texels.parameters) EXPECT_TRUE(std::isfinite(value));
  for (const LobeJob& job : jobs) EXPECT_LT(job.cost, 1e-3f);
}

}  // namespace
}  // namespace weft
