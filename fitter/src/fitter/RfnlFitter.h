#pragma once

#include "weft/fitter/Fitter.h"

namespace weft {

/// Fits `rfnl`: the lobes of each view by Levenberg-Marquardt (Ceres' TinySolver) from several starts,
/// alternating with a closed-form diffuse albedo where the views share one.
class RfnlFitter : public TexelFitter {
 public:
  /// Fails where there are fewer lights than parameters of a view.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);

  void fit(std::span<const float> luminance, std::span<float> shared, std::span<float> views) const override;

 private:
  explicit RfnlFitter(const FitProblem& problem);

  std::vector<glm::dvec3> lights_;
  std::vector<double>
      cosines_;  ///< what the model is multiplied by for each light: n.l, or 1 if it contains it
  std::vector<std::vector<int>> neighbors_;  ///< of each light, the six nearest others
  std::size_t views_ = 0;
  std::size_t lobes_ = 0;
  bool ownDiffuseAlbedo_ = false;
  double largestExponent_ = 80.0;
};

}  // namespace weft
