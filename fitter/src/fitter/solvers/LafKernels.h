#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "solvers/AlignedFloats.h"

namespace weft {

/// Points P = (lx vx, ly vy, lz vz); the arrays are of one padded size.
struct LafPoints {
  AlignedFloats x, y, z;

  explicit LafPoints(std::span<const glm::vec3> points);
};

/// A lobe, amplitude * max(0, axes . P)^exponent, and two directions in which its axes may turn.
struct LafTerms {
  float amplitude = 0.0f;
  float exponent = 1.0f;
  glm::vec3 axes, first, second;
};

/// What the model at each point is multiplied by (0 for padding), and what that is compared with.
struct LafSamples {
  const LafPoints& points;
  const AlignedFloats& scales;
  const AlignedFloats& targets;
};

/// Adds to `gram`, of lafGramSize(lobes) floats, the Gram matrix of the rows that least squares
/// needs, lower triangle row by row. The rows are, a number a point: for every lobe the derivatives
/// of the scaled model by amplitude, the two turns and the logarithm of the exponent; that by the
/// diffuse albedo; the residuals (scaled model less target). So the last row holds gradient and
/// cost.
void addLafGram(const LafSamples& samples, std::span<const LafTerms> lobes, float diffuse,
                std::span<float> gram);
constexpr std::size_t lafGramSize(std::size_t lobes) {
  return (4 * lobes + 2) * (4 * lobes + 3) / 2;
}

/// The model at every point: diffuse + lobes.
void lafValues(const LafPoints& points, std::span<const LafTerms> lobes, float diffuse,
               AlignedFloats& values);

/// Sums over points of what a candidate and the samples have in common.
struct LafCorrelation {
  float residual;  ///< scale * candidate * residual
  float diffuse;   ///< scale * candidate * scale
  float square;    ///< (scale * candidate)^2
};

/// For every candidate, a row of `candidates` with its value at each point.
void lafCorrelations(const AlignedFloats& scales, const AlignedFloats& residuals,
                     const AlignedFloats& candidates, std::span<LafCorrelation> sums);

}  // namespace weft
