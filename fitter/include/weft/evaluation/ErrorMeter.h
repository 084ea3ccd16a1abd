#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/evaluation/FitErrors.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/FieldFormula.h"

namespace weft {

/// The errors of one texel, apart for the pairs that were fitted and those that were held out.
struct SplitErrors {
  TexelErrors fitted;
  TexelErrors heldOut;
};

/// summarize() of one part: `summarize(texels, &SplitErrors::heldOut)`.
FitErrors summarize(std::span<const SplitErrors> texels, TexelErrors SplitErrors::*part);

/// Compares the numbers of texels with all their samples: what weft-fit and weft-eval report. Thread safe.
class ErrorMeter {
 public:
  /// Pairs whose view or light is not among the fitted directions of `description` count as held out. Lights
  /// on or below the horizon count nowhere: whatever an image of them shows, the surface is not lit.
  ErrorMeter(FieldFormula formula, const ReflectanceFieldDescription& description,
             const BtfDescription& measured);

  /// Whether there are held-out pairs at all.
  bool holdsOut() const { return holdsOut_; }
  /// Whether the pairs that are fitted are all that were measured.
  bool fitsAllPairs() const;
  /// Which of the measured directions were fitted.
  const std::vector<bool>& fittedViews() const { return viewIsFitted_; }
  const std::vector<bool>& fittedLights() const { return lightIsFitted_; }

  /// `shared`: the model's shared channels; `layers`: `[layer][channel]`; samples `[view][light]` of all
  /// measured pairs, n.l included, linear and as stored.
  SplitErrors measure(std::span<const float> shared, std::span<const float> layers,
                      std::span<const glm::vec3> linear, std::span<const glm::vec3> stored) const;

 private:
  // Pairs of one view that are all fitted or all held out.
  struct Run {
    std::size_t view = 0;
    std::size_t firstLight = 0;
    std::size_t count = 0;
    bool isFitted = true;
  };

  std::vector<Run> findRuns() const;
  template <class Function>
  void forEachLayer(std::size_t direction, std::span<const float> layers, const Function& function) const;
  void evaluateView(std::span<const float> shared, std::span<const float> layers, std::size_t view,
                    std::span<glm::vec3> values) const;

  FieldFormula formula_;
  std::vector<glm::vec3> views_;
  std::vector<glm::vec3> lights_;
  Encoding encoding_;
  std::vector<bool> viewIsFitted_;
  std::vector<bool> lightIsFitted_;
  std::vector<Run> runs_;  ///< view by view
  ModelledLights modelledLights_;
  bool layersAreLights_ = false;
  std::vector<DirectionWeights> layers_;  ///< around each view, or light, of the measurement
  bool holdsOut_ = false;
};

}  // namespace weft
