#pragma once

#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Fits a light field with the fitter of the reflectance field of the same formula: light and view
/// are exchanged.
class ExchangedFitter : public TexelFitter {
 public:
  using Factory = Result<std::unique_ptr<TexelFitter>> (*)(const FitProblem&);

  /// `factory` makes the fitter that this one hands the transposed samples to.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem, Factory factory);

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  ExchangedFitter(std::unique_ptr<TexelFitter> fitter, std::vector<float> cosines, std::size_t views)
      : fitter_(std::move(fitter)), cosines_(std::move(cosines)), views_(views) {}

  std::unique_ptr<TexelFitter> fitter_;
  std::vector<float> cosines_;  ///< of the lights, or 1 where the model contains them
  std::size_t views_;
};

}  // namespace weft
