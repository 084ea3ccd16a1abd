#pragma once

#include <functional>

#include "weft/fitter/TexelFitter.h"

namespace weft {

class LinearLeastSquares;

/// Fits models whose value is a sum of terms of the light, each times one number of the view's
/// layer: weighted linear least squares, view by view.
class LinearFitter : public TexelFitter {
 public:
  /// Fills in what each of the model's layer numbers is multiplied by for a light.
  using Terms = std::function<void(glm::vec3 light, std::span<double> terms)>;

  /// Fails where the lights do not determine the numbers.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem, const Terms& terms);
  ~LinearFitter() override;

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  LinearFitter(std::unique_ptr<const LinearLeastSquares> solver, bool weighted);

  std::unique_ptr<const LinearLeastSquares> solver_;
  bool weighted_;
};

}  // namespace weft
