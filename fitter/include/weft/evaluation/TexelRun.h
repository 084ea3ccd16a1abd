#pragma once

#include <optional>
#include <vector>

#include "weft/evaluation/FittedPairs.h"
#include "weft/evaluation/TexelSamples.h"

namespace weft {

/// A row of texels among the samples that were read.
struct SampledRow {
  const SampleRows& samples;
  int sampleRow = 0;  ///< within `samples`
  const BtfDescription& measured;
  const FittedPairs& pairs;
  int firstColumn = 0;  ///< of the measurement, where the row begins
  int width = 0;
  int y = 0;  ///< the row within the field
};

/// Neighbouring texels of one row, as fits and errors look at them. Their samples are decoded when
/// they are asked for, once. For one thread.
class TexelRun {
 public:
  /// How many texels a run has, but for the last of a row: few, so that their samples stay in the
  /// cache.
  static constexpr int kTexels = 8;
  static int runsIn(int width) { return (width + kTexels - 1) / kTexels; }

  /// The run of that number of a row, which must outlive it.
  TexelRun(const SampledRow& row, int run);

  int size() const { return static_cast<int>(measured_.size()); }
  /// Where the first texel lies in the field.
  int x() const { return x_; }
  int y() const { return row_.y; }
  /// The samples of one of the texels: all pairs, `[view][light]`.
  const TexelSamples& measured(int texel);
  /// The same without the pairs that are held out.
  const TexelSamples& fitted(int texel);

 private:
  const SampledRow& row_;
  int x_;
  std::vector<std::optional<TexelSamples>> measured_;
  std::vector<std::optional<TexelSamples>> fitted_;
};

}  // namespace weft
