#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

namespace weft {

/// Least squares for unknowns that enter linearly: many sets of samples with one matrix of terms,
/// as the views of a texel are under the same lights. Thread safe.
class LinearLeastSquares {
 public:
  /// `terms`: a row a sample, a column an unknown. Nothing where the samples do not determine the
  /// unknowns.
  static std::optional<LinearLeastSquares> create(const Eigen::MatrixXd& terms);

  /// Minimises the sum of (weight (target - terms solution))^2 of each set. `targets` and `weights`
  /// are `[set][sample]`, finite; `solutions` are `[set][unknown]`, finite, also where all weights
  /// are 0.
  void solve(std::span<const float> targets, std::span<const float> weights,
             std::span<float> solutions) const;
  /// The same with equal weights.
  void solve(std::span<const float> targets, std::span<float> solutions) const;

 private:
  explicit LinearLeastSquares(const Eigen::MatrixXd& terms);

  Eigen::MatrixXf terms_;  ///< a column a sample
  /// a column a sample: products of two of its terms, lower triangle by rows
  Eigen::MatrixXf products_;
  Eigen::MatrixXf pseudoInverse_;  ///< the same for every set where weights are equal
};

}  // namespace weft
