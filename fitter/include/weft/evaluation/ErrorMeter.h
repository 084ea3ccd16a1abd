#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/evaluation/FitErrors.h"
#include "weft/evaluation/FittedPairs.h"
#include "weft/evaluation/RunParameters.h"
#include "weft/evaluation/TexelRun.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/FieldFormula.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// The errors of one texel, apart for the pairs that were fitted and those that were held out.
struct SplitErrors {
  TexelErrors fitted;
  TexelErrors heldOut;
};

/// summarize() of one part: `summarize(texels, &SplitErrors::heldOut)`.
FitErrors summarize(std::span<const SplitErrors> texels, TexelErrors SplitErrors::*part);

/// Compares the parameters of texels with all their samples: what weft-fit and weft-eval report.
/// Thread safe.
class ErrorMeter {
 public:
  ErrorMeter(FieldFormula formula, FittedPairs pairs, const BtfDescription& measured);

  const FittedPairs& pairs() const { return pairs_; }
  /// The errors of the texels of a run, over all measured pairs; of the surface's texels where the
  /// run is registered.
  void measure(const RunParameters& parameters, TexelRun& texels, std::span<SplitErrors> errors) const;
  /// The errors of what a field shows at the texels of a run, which is not registered.
  void measure(const ReflectanceField& field, TexelRun& texels, std::span<SplitErrors> errors) const;

 private:
  // Pairs of one view that are all fitted or all held out.
  struct Run {
    std::size_t view = 0;
    std::size_t firstLight = 0;
    std::size_t count = 0;
    bool isFitted = true;
  };

  std::vector<Run> findRuns() const;
  template <class SharedOf>
  SplitErrors measureTexel(const SharedOf& sharedOf, std::span<const float> layers,
                           const TexelSamples& samples) const;
  template <class Function>
  void forEachLayer(std::size_t direction, const Function& function) const;
  void evaluateView(std::span<const float> shared, std::span<const float> layers, std::size_t view,
                    std::span<glm::vec3> values) const;

  FieldFormula formula_;
  FittedPairs pairs_;
  std::vector<glm::vec3> views_;
  std::vector<glm::vec3> lights_;
  Encoding encoding_;
  std::vector<Run> runs_;  ///< view by view
  ModelledLights modelledLights_;
  bool layersAreLights_ = false;
  std::vector<DirectionWeights> layers_;  ///< around each view, or light, of the measurement
};

}  // namespace weft
