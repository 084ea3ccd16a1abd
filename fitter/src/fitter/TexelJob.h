#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "FittedRows.h"
#include "weft/evaluation/ErrorMeter.h"
#include "weft/evaluation/TexelSamples.h"
#include "weft/fitter/FieldFit.h"

namespace weft {

/// From the samples of one texel to its numbers and their errors: all that is between reading and a
/// TexelFitter. Thread safe.
class TexelJob {
 public:
  TexelJob(const BtfDescription& measured, const FitOptions& options, const ErrorMeter& meter,
           const TexelFitter& fitter, const ReflectanceModel& model);

  /// Fits the texel in a row and column of `samples` and puts it into `to` at (x, y).
  void fit(const SampleRows& samples, int row, int column, FittedRows& to, int x, int y) const;

 private:
  std::vector<glm::vec3> fittedOf(const std::vector<glm::vec3>& all) const;
  Encoding displayEncoding() const;
  std::vector<glm::vec3> displayed(const TexelSamples& samples) const;
  void fitChannels(const TexelSamples& samples, std::span<float> shared, std::span<float> layers) const;

  const BtfDescription& measured_;
  const FitOptions& options_;
  const ErrorMeter& meter_;
  const TexelFitter& fitter_;
  const ReflectanceModel& model_;
};

}  // namespace weft
