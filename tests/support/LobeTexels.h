#pragma once

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "MemoryBtf.h"
#include "weft/fitter/LobeSolver.h"

namespace weft::test {

/// Small fits for tests and benchmarks of solveLobes(): samples and starting points that live as
/// long as they.
struct LobeTexels {
  LobeProblem problem;
  int lobes = 2;
  std::vector<float> luminance, weights, parameters;

  std::size_t stride() const { return static_cast<std::size_t>(4 * lobes + 1); }
  std::size_t size() const { return luminance.size() / problem.lights.size(); }
  std::vector<LobeJob> jobs() {
    std::vector<LobeJob> result;
    for (std::size_t i = 0; i < size(); ++i)
      result.push_back({&luminance[i * problem.lights.size()], &weights[i * problem.lights.size()],
                        &parameters[i * stride()]});
    return result;
  }
};

/// Two lobes over a diffuse albedo under UBO2003's lights, with noise of 2 % and a third of the
/// lights of some texels in shadow; the starts are the truth disturbed.
inline LobeTexels syntheticTexels(std::size_t count) {
  LobeTexels texels;
  texels.problem.lights = ubo2003Sampling();
  for (glm::vec3 light : texels.problem.lights) texels.problem.cosines.push_back(light.z);
  std::mt19937 random(42);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> noise(0.0f, 0.02f);
  for (std::size_t texel = 0; texel < count; ++texel) {
    const float diffuse = 0.05f + 0.2f * unit(random);
    glm::vec3 directions[2];
    float amplitudes[2], exponents[2];
    for (int j = 0; j < 2; ++j) {
      directions[j] = directionFromDegrees(70.0 * unit(random), 360.0 * unit(random));
      amplitudes[j] = 0.1f + 0.6f * unit(random);
      exponents[j] = std::exp(unit(random) * std::log(j == 0 ? 5.0f : 40.0f));
      const float share = std::clamp(std::log(exponents[j]) / std::log(80.0f), 0.05f, 0.95f);
      const glm::vec2 p = parabolicFromDirection(directions[j]);
      for (float value :
           {std::sqrt(amplitudes[j]) * (0.6f + 0.8f * unit(random)), p.x + 0.3f * unit(random) - 0.15f,
            p.y + 0.3f * unit(random) - 0.15f, std::log(share / (1.0f - share)) + unit(random) - 0.5f})
        texels.parameters.push_back(value);
    }
    texels.parameters.push_back(std::sqrt(diffuse) * (0.7f + 0.6f * unit(random)));
    const glm::vec3 shadow = directionFromDegrees(90.0, 360.0 * unit(random));
    const bool shadowed = unit(random) < 0.5f;
    for (std::size_t i = 0; i < texels.problem.lights.size(); ++i) {
      const glm::vec3 l = texels.problem.lights[i];
      float value = diffuse;
      for (int j = 0; j < 2; ++j)
        value += amplitudes[j] * std::pow(std::max(glm::dot(directions[j], l), 0.0f), exponents[j]);
      if (shadowed && glm::dot(shadow, l) > 0.35f) value *= 0.2f;
      texels.luminance.push_back(std::max(l.z * value * (1.0f + noise(random)), 0.0f));
      texels.weights.push_back(1.0f / std::sqrt(texels.luminance.back() + 0.01f));
    }
  }
  return texels;
}

/// The residuals of a job in double precision, written plainly, for ceres::TinySolver: what
/// solveLobes() is checked against.
struct ReferenceResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 9 };

  const LobeProblem& problem;
  const LobeJob& job;

  int NumResiduals() const { return static_cast<int>(problem.lights.size()); }

  bool operator()(const double* p, double* residuals, double* jacobian) const {
    const std::size_t count = problem.lights.size();
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 l = problem.lights[i];
      const double scale = double{job.weights[i]} * problem.cosines[i];
      residuals[i] = scale * p[8] * p[8] - double{job.weights[i]} * job.luminance[i];
      if (jacobian) jacobian[8 * count + i] = 2.0 * scale * p[8];
      for (int j = 0; j < 2; ++j)
        addLobe(p + 4 * j, l, scale, i, residuals,
                jacobian ? jacobian + 4 * j * static_cast<int>(count) : nullptr);
    }
    return true;
  }

 private:
  void addLobe(const double* p, glm::dvec3 l, double scale, std::size_t i, double* residuals,
               double* jacobian) const {
    const std::size_t count = problem.lights.size();
    const double squared = p[1] * p[1] + p[2] * p[2];
    const glm::dvec3 m = glm::dvec3(2.0 * p[1], 2.0 * p[2], 1.0 - squared) / (1.0 + squared);
    const glm::dvec3 byX = (glm::dvec3(2.0, 0.0, -2.0 * p[1]) - 2.0 * p[1] * m) / (1.0 + squared);
    const glm::dvec3 byY = (glm::dvec3(0.0, 2.0, -2.0 * p[2]) - 2.0 * p[2] * m) / (1.0 + squared);
    const double sigmoid = 1.0 / (1.0 + std::exp(-p[3]));
    const double logLargest = std::log(double{problem.largestExponent});
    const double exponent = std::exp(logLargest * sigmoid);
    const double dot = glm::dot(m, l);
    const double power = dot > 1e-6 ? scale * std::pow(dot, exponent) : 0.0;
    residuals[i] += p[0] * p[0] * power;
    if (!jacobian) return;
    const double byDot = dot > 1e-6 ? p[0] * p[0] * power * exponent / dot : 0.0;
    jacobian[i] = 2.0 * p[0] * power;
    jacobian[count + i] = byDot * glm::dot(byX, l);
    jacobian[2 * count + i] = byDot * glm::dot(byY, l);
    jacobian[3 * count + i] =
        dot > 1e-6 ? p[0] * p[0] * power * std::log(dot) * exponent * logLargest * sigmoid * (1.0 - sigmoid)
                   : 0.0;
  }
};

/// What ceres::TinySolver makes of a two-lobe job: improves the parameters and sets the cost.
inline void solveByReference(const LobeProblem& problem, LobeJob& job, int iterations) {
  const ReferenceResiduals residuals{problem, job};
  ceres::TinySolver<ReferenceResiduals> solver;
  solver.options.max_num_iterations = iterations;
  Eigen::Matrix<double, 9, 1> x;
  for (int k = 0; k < 9; ++k) x[k] = job.parameters[k];
  job.cost = static_cast<float>(2.0 * solver.Solve(residuals, &x).final_cost);
  for (int k = 0; k < 9; ++k) job.parameters[k] = static_cast<float>(x[k]);
}

}  // namespace weft::test
