#pragma once

#include "weft/fitter/LafSolver.h"
#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Fits `laf`: one set of lobes to all views of a texel at once (LafSolver.h); and `slaf`: the
/// same, alternating with view factors in closed form.
class LafFitter : public TexelFitter {
 public:
  /// Fails where there are fewer samples than numbers.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  explicit LafFitter(const FitProblem& problem);

  LafSolver solver_;
  std::vector<float> cosines_;  ///< of the lights, or 1 where the model contains them
  int lobes_ = 0;
  bool hasViewFactor_ = false;
};

}  // namespace weft
