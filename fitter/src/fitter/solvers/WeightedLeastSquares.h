#pragma once

#include <cstddef>
#include <span>

#include "solvers/AlignedFloats.h"

namespace weft {

/// The terms of many sets of samples, as the SIMD code reads them.
struct SharedTerms {
  /// The samples of all sets are read in pieces of so many.
  static constexpr std::size_t kSamplesAtOnce = 128;

  /// `terms`: `[sample][unknown]`.
  SharedTerms(std::span<const float> terms, std::size_t unknowns);
  const float* of(std::size_t unknown) const { return terms.data() + unknown * stride; }

  std::size_t samples;
  std::size_t unknowns;
  std::size_t stride;   ///< samples, padded with zeros
  AlignedFloats terms;  ///< `[unknown][stride]`
  AlignedFloats ridge;  ///< an unknown each, for a mean squared weight of 1
};

/// Least squares for some tens of unknowns that enter linearly: many sets of samples with the same
/// terms, and weights of each set's own, as texels against components that all texels share. The
/// normal equations of many sets are summed at once, in SIMD lanes. Thread safe.
///
/// The result of a set does not depend on the other sets. A small ridge, in proportion to the mean
/// weight of a set, keeps sets of few samples bounded.
class WeightedLeastSquares {
 public:
  /// The ridge: so many times the mean squared weight of a set and the sum of the squares of an
  /// unknown's terms are added to the diagonal of the normal equations.
  static constexpr float kRidge = 1e-5f;
  /// A multiple of this many sets at once leaves no lane idle.
  static constexpr std::size_t kSetsAtOnce = 32;

  /// `terms`: `[sample][unknown]`, finite.
  WeightedLeastSquares(std::span<const float> terms, std::size_t unknowns) : terms_(terms, unknowns) {}

  std::size_t samples() const { return terms_.samples; }
  std::size_t unknowns() const { return terms_.unknowns; }

  /// Minimises the sum of squaredWeight (value - terms solution)^2 of each set. `values` and
  /// `squaredWeights` are `[set][sample]`, finite and the latter not negative; `solutions` are
  /// `[set][unknown]`, finite: 0 where all weights are, and for unknowns whose terms are.
  void solve(std::span<const float> values, std::span<const float> squaredWeights,
             std::span<float> solutions) const;
  /// The sums over samples of terms times values, `[set][unknown]`.
  void project(std::span<const float> values, std::span<float> products) const;

 private:
  SharedTerms terms_;
};

}  // namespace weft
