#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace weft {

/// What all small fits of a solver have in common.
struct LobeProblem {
  std::vector<glm::vec3> lights;  ///< unit, tangent frame
  std::vector<float>
      cosines;  ///< what the model is multiplied by for each light: n.l, or 1 if it contains it
  float largestExponent = 80.0f;
};

/// One small fit: the samples of a texel in a view, and where to start.
///
/// `parameters` are four numbers a lobe without bounds, then one for the diffuse albedo: root of
/// the amplitude, direction in parabolic coordinates, and b for an exponent of
/// largestExponent^(1/(1 + e^-b)); root of the diffuse albedo.
struct LobeJob {
  const float* luminance = nullptr;  ///< a sample a light
  const float* weights = nullptr;    ///< factors of the residuals
  float* parameters = nullptr;       ///< improved in place; always finite if they were
  float cost = 0.0f;                 ///< set: the sum of the squared weighted residuals
  float diffuseSlope = 0.0f;         ///< set: half the derivative of the cost by the diffuse albedo
};

enum class DiffuseSolve { Solve, Hold };

/// Improves all jobs by Levenberg-Marquardt, as many side by side as the processor has SIMD lanes:
/// a lane takes the next job when its own has converged or had its iterations (Highway picks the
/// instruction set at run time).
///
/// lobes is 1 to 4. A job's result does not depend on the other jobs. Thread safe; source: the
/// model of paper [Meseth 2004] eq. 1.
void solveLobes(const LobeProblem& problem, int lobes, DiffuseSolve diffuse, int iterations,
                std::span<LobeJob> jobs);

}  // namespace weft
