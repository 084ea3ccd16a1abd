#pragma once

#include <Eigen/Core>

#include "weft/fitter/Fitter.h"

namespace weft {

/// Fits `rfp` view by view: a weighted linear least-squares problem with six unknowns.
class RfpFitter : public TexelFitter {
 public:
  /// Fails where the lights do not determine the six coefficients: fewer than six, or on one conic.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  using Basis = Eigen::Matrix<double, Eigen::Dynamic, 6>;
  explicit RfpFitter(Basis basis) : basis_(std::move(basis)) {}

  Basis basis_;  ///< a row a light: what multiplies a0..a5
};

}  // namespace weft
