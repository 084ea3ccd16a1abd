#pragma once

#include <memory>

#include "FitWeights.h"
#include "weft/fitter/FieldFitter.h"
#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Fits every texel by itself: base colour, then a TexelFitter for luminance or each colour
/// channel.
class TexelFieldFitter : public FieldFitter {
 public:
  TexelFieldFitter(const FitProblem& problem, std::unique_ptr<TexelFitter> fitter);

  const TexelFitter& texelFitter() const { return *fitter_; }
  void fit(TexelRun& texels, RunParameters& parameters) const override;
  bool fitsLevels() const override { return true; }

 private:
  void fitTexel(const TexelSamples& samples, std::span<float> shared, std::span<float> layers) const;
  FitTargets targetsOf(const TexelSamples& samples, std::size_t channel, glm::vec3 baseColor) const;

  std::shared_ptr<const ReflectanceModel> model_;
  bool weighted_;
  Encoding encoding_;
  std::unique_ptr<TexelFitter> fitter_;
};

}  // namespace weft
