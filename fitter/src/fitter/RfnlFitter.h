#pragma once

#include "weft/fitter/Fitter.h"

namespace weft {

/// What is the same for all texels of an `rfnl` fit.
struct RfnlProblem {
  std::vector<glm::dvec3> lights;
  std::vector<double>
      cosines;  ///< what the model is multiplied by for each light: n.l, or 1 if it contains it
  std::vector<std::vector<int>> neighbors;  ///< of each light, the six nearest others
  std::size_t views = 0;
  bool modelHasCosine = false;
  double largestExponent = 80.0;  ///< a sharper lobe could hide between two lights
};

/// Fits `rfnl`: the lobes of each view by Levenberg-Marquardt (Ceres' TinySolver) from several starts,
/// alternating with a closed-form diffuse albedo where the views share one.
class RfnlFitter : public TexelFitter {
 public:
  /// Fails where there are fewer lights than parameters of a view.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);

  void fit(std::span<const float> luminance, std::span<float> shared, std::span<float> views) const override;

 private:
  explicit RfnlFitter(const FitProblem& problem);

  RfnlProblem problem_;
  int lobes_ = 0;
  bool ownDiffuseAlbedo_ = false;
};

}  // namespace weft
