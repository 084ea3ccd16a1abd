#pragma once

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "MemoryBtf.h"
#include "weft/fitter/LafSolver.h"

namespace weft::test {

/// Fits for tests and benchmarks of LafSolver: samples of texels, and starting points.
struct LafTexels {
  LafProblem problem;
  std::vector<LafFit> truths;
  std::vector<LafFit> starts;
  std::vector<std::vector<float>> targets;
  std::vector<std::vector<float>> scales;

  std::size_t size() const { return truths.size(); }
  LafJob job(std::size_t texel) const { return {targets[texel], scales[texel]}; }
};

/// The model, written plainly.
inline double lafValue(const LafFit& fit, glm::dvec3 light, glm::dvec3 view) {
  double value = fit.diffuse;
  for (const LafLobe& lobe : fit.lobes)
    value += double{lobe.amplitude} *
             std::pow(std::max(glm::dot(glm::dvec3(lobe.axes), light * view), 0.0), double{lobe.exponent});
  return value;
}

inline double lafCost(const LafProblem& problem, const LafJob& job, const LafFit& fit) {
  double cost = 0.0;
  for (std::size_t i = 0; i < job.targets.size(); ++i) {
    const double value =
        lafValue(fit, problem.lights[i % problem.lights.size()], problem.views[i / problem.lights.size()]);
    cost += std::pow(double{job.targets[i]} - double{job.scales[i]} * value, 2.0);
  }
  return cost;
}

/// A retro-reflecting and a mirroring lobe, both off their ideal axes, over a diffuse albedo; with
/// the noise asked for, and then half of the views of some texels in shadow. The starts are the
/// truth disturbed.
inline LafTexels syntheticLafTexels(std::size_t count, float noise, std::vector<glm::vec3> directions) {
  LafTexels texels;
  texels.problem = {directions, directions};
  std::mt19937 random(1997);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const auto between = [&](float low, float high) { return low + (high - low) * unit(random); };
  std::normal_distribution<float> normal(0.0f, 1.0f);
  for (std::size_t texel = 0; texel < count; ++texel) {
    const LafFit truth{
        between(0.05f, 0.2f),
        {{between(0.2f, 0.6f), {between(0.2f, 0.7f), between(0.2f, 0.7f), 1.0f}, between(2.0f, 6.0f)},
         {between(0.3f, 1.0f), {between(-1.0f, -0.8f), between(-1.0f, -0.8f), 1.0f}, between(6.0f, 30.0f)}}};
    LafFit start = truth;
    start.diffuse *= between(0.7f, 1.3f);
    for (LafLobe& lobe : start.lobes) {
      lobe.amplitude *= between(0.7f, 1.3f);
      lobe.axes.x = std::clamp(lobe.axes.x + between(-0.15f, 0.15f), -1.0f, 1.0f);
      lobe.axes.y = std::clamp(lobe.axes.y + between(-0.15f, 0.15f), -1.0f, 1.0f);
      lobe.exponent *= between(0.7f, 1.3f);
    }
    const glm::vec3 shadow = directionFromDegrees(60.0, between(0.0f, 360.0f));
    const bool shadowed = noise > 0.0f && unit(random) < 0.5f;
    std::vector<float> targets;
    std::vector<float> scales;
    for (const glm::vec3 view : directions)
      for (const glm::vec3 light : directions) {
        double value = light.z * lafValue(truth, light, view) * (1.0f + noise * normal(random));
        if (shadowed && glm::dot(shadow, view) > 0.6f) value *= 0.5;
        const float weight = 1.0f / std::sqrt(static_cast<float>(std::max(value, 0.0)) + 0.01f);
        targets.push_back(weight * static_cast<float>(value));
        scales.push_back(weight * light.z);
      }
    texels.truths.push_back(truth);
    texels.starts.push_back(start);
    texels.targets.push_back(std::move(targets));
    texels.scales.push_back(std::move(scales));
  }
  return texels;
}

/// The residuals of a two-lobe job over all samples, none merged, for ceres::TinySolver. A lobe is
/// the root of the amplitude, two numbers for axes of length one, as parabolic coordinates, and the
/// logarithm of the exponent.
struct LafResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 9 };

  const LafProblem& problem;
  const LafJob& job;

  int NumResiduals() const { return static_cast<int>(job.targets.size()); }

  bool operator()(const double* p, double* residuals, double* jacobian) const {
    const std::size_t count = job.targets.size();
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 product =
          problem.lights[i % problem.lights.size()] * problem.views[i / problem.lights.size()];
      const double scale = job.scales[i];
      residuals[i] = scale * p[8] * p[8] - double{job.targets[i]};
      if (jacobian) jacobian[8 * count + i] = 2.0 * scale * p[8];
      for (std::size_t j = 0; j < 2; ++j)
        addLobe(p + 4 * j, product, scale, residuals[i], jacobian ? jacobian + 4 * j * count + i : nullptr);
    }
    return true;
  }

 private:
  void addLobe(const double* p, glm::dvec3 product, double scale, double& residual, double* jacobian) const {
    const std::size_t count = job.targets.size();
    const double squared = p[1] * p[1] + p[2] * p[2];
    const glm::dvec3 axes = glm::dvec3(2.0 * p[1], 2.0 * p[2], 1.0 - squared) / (1.0 + squared);
    const glm::dvec3 byX = (glm::dvec3(2.0, 0.0, -2.0 * p[1]) - 2.0 * p[1] * axes) / (1.0 + squared);
    const glm::dvec3 byY = (glm::dvec3(0.0, 2.0, -2.0 * p[2]) - 2.0 * p[2] * axes) / (1.0 + squared);
    const double exponent = std::exp(p[3]);
    const double base = glm::dot(axes, product);
    const double power = base > 1e-6 ? scale * std::pow(base, exponent) : 0.0;
    residual += p[0] * p[0] * power;
    if (!jacobian) return;
    const double byBase = base > 1e-6 ? p[0] * p[0] * power * exponent / base : 0.0;
    jacobian[0] = 2.0 * p[0] * power;
    jacobian[count] = byBase * glm::dot(byX, product);
    jacobian[2 * count] = byBase * glm::dot(byY, product);
    jacobian[3 * count] = base > 1e-6 ? p[0] * p[0] * power * std::log(base) * exponent : 0.0;
  }
};

/// The cost that ceres::TinySolver comes to from a two-lobe fit.
inline double lafCostByReference(const LafProblem& problem, const LafJob& job, const LafFit& start,
                                 int iterations) {
  Eigen::Matrix<double, 9, 1> x;
  for (int j = 0; j < 2; ++j) {
    const LafLobe& lobe = start.lobes[static_cast<std::size_t>(j)];
    const double length = glm::length(lobe.axes);
    const glm::dvec3 unit = glm::dvec3(lobe.axes) / length;
    x[4 * j] = std::sqrt(lobe.amplitude * std::pow(length, lobe.exponent));
    x[4 * j + 1] = unit.x / (1.0 + unit.z);
    x[4 * j + 2] = unit.y / (1.0 + unit.z);
    x[4 * j + 3] = std::log(lobe.exponent);
  }
  x[8] = std::sqrt(start.diffuse);
  ceres::TinySolver<LafResiduals> solver;
  solver.options.max_num_iterations = iterations;
  return 2.0 * solver.Solve(LafResiduals{problem, job}, &x).final_cost;
}

}  // namespace weft::test
