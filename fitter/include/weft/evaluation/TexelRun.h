#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "weft/evaluation/FittedPairs.h"
#include "weft/evaluation/SampleWindow.h"
#include "weft/evaluation/TexelSamples.h"
#include "weft/measurement/Crop.h"

namespace weft {

/// A row of texels among the samples that were read.
struct SampledRow {
  const SampleWindow& samples;
  const BtfDescription& measured;
  const FittedPairs& pairs;
  Crop crop;  ///< the field within the measurement
  int y = 0;  ///< the row within the field
  /// Where a texel of the surface is seen in each measured view: that many texels away, y up.
  /// Empty: where it is.
  std::span<const glm::ivec2> registration{};
};

/// Neighbouring texels of one row, as fits and errors look at them: of the surface, where its views
/// are registered. Their samples are decoded when they are asked for, once. For one thread.
class TexelRun {
 public:
  /// How many texels a run has, but for the last of a row: few, so that their samples stay in the
  /// cache.
  static constexpr int kTexels = 8;
  static int runsIn(int width, int length = kTexels) { return (width + length - 1) / length; }

  /// The run of that number of a row, which must outlive it.
  TexelRun(const SampledRow& row, int run, int length = kTexels);

  int size() const { return static_cast<int>(measured_.size()); }
  /// Where the first texel lies in the field.
  int x() const { return x_; }
  int y() const { return row_.y; }
  /// The samples of one of the texels: all pairs, `[view][light]`.
  const TexelSamples& measured(int texel);
  /// The same without the pairs that are held out.
  const TexelSamples& fitted(int texel);

 private:
  TexelSamples samplesOf(int texel) const;

  const SampledRow& row_;
  int x_;
  std::vector<std::optional<TexelSamples>> measured_;
  std::vector<std::optional<TexelSamples>> fitted_;
};

}  // namespace weft
