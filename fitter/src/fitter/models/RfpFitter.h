#pragma once

#include <Eigen/Core>

#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Fits `rfp`, `lfp` and `ptm` view by view: a linear least-squares problem with six unknowns.
class RfpFitter : public TexelFitter {
 public:
  /// Fails where the lights do not determine the six coefficients: fewer than six, or on one conic.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);
  /// The same for `lfp`, of which light and view are exchanged.
  static Result<std::unique_ptr<TexelFitter>> createForLights(const FitProblem& problem);
  /// The same for `ptm`, which is refused for more views.
  static Result<std::unique_ptr<TexelFitter>> createForOneView(const FitProblem& problem);

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  using Basis = Eigen::Matrix<float, 6, Eigen::Dynamic>;
  RfpFitter(const Eigen::MatrixXd& basis, bool weighted);

  Basis basis_;                                        ///< a column a light: what multiplies a0..a5
  Eigen::Matrix<float, 21, Eigen::Dynamic> products_;  ///< a column a light: products of two of them
  Basis pseudoInverse_;                                ///< the same for every view where weights are equal
  bool weighted_;
};

}  // namespace weft
