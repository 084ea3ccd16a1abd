#pragma once

#include "weft/fitter/LobeSolver.h"
#include "weft/fitter/TexelFitter.h"

namespace weft {

/// What lies around each of the lights.
struct LightNeighbors {
  std::vector<std::vector<int>> nearest;  ///< the six nearest others, the nearest first
  std::vector<std::vector<int>> close;    ///< all within 30 degrees
};

/// Fits `rfnl` and `lfnl`: the lobes of each view from several starts (LobeSolver.h), alternating
/// with a closed-form diffuse albedo where the views share one.
class RfnlFitter : public TexelFitter {
 public:
  /// Fails where there are fewer lights than parameters of a view.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);
  /// The same for `lfnl`, of which light and view are exchanged.
  static Result<std::unique_ptr<TexelFitter>> createForLights(const FitProblem& problem);

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  explicit RfnlFitter(const FitProblem& problem);

  LobeProblem problem_;
  LightNeighbors neighbors_;
  int lobes_ = 0;
  bool ownDiffuseAlbedo_ = false;
  bool modelHasCosine_ = false;
  bool layersAreViews_ = true;
  /// How many times its layer's brightest sample a value may reach.
  float brightestShare_ = 1.0f;
};

}  // namespace weft
