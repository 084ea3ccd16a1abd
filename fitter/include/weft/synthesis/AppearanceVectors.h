#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// A vector for each texel of a sample; the distance of two is how differently they look, the root
/// mean square over pairs of view and light of their stored values (about 0..1).
struct AppearanceVectors {
  int width = 0;
  int height = 0;
  int dimensions = 0;
  std::vector<float> values;  ///< `[row][column][dimension]`

  const float* at(int x, int y) const {
    return values.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(dimensions);
  }
  float* at(int x, int y) { return const_cast<float*>(std::as_const(*this).at(x, y)); }
  /// The distance of two texels.
  float distance(int x0, int y0, int x1, int y1) const;
};

/// Which views count: those between two polar angles, in degrees.
struct PolarRange {
  float lowest = 0.0f;
  float highest = 90.0f;
};

/// What synthesis knows of a sample.
struct AppearanceSample {
  AppearanceVectors vectors;
  /// Texels along each border that are no sources, because what they show came from the opposite
  /// border.
  int margin = 0;
  /// Opposite borders continue each other, so that the sample tiles as it is.
  bool repeats = false;
  /// The share of the variance over all pairs that the vectors have kept.
  double keptVariance = 1.0;
  std::string name;                   ///< of the measurement, for people
  std::vector<std::string> warnings;  ///< what is assumed, a sentence each
};

/// Of a fitted field. Those of `loom` are its weights under the metric of its components: all pairs
/// count, and texels are compared where they are in the surface, whatever the view. Of other models
/// up to 240 representative pairs are evaluated. Vectors are reduced to their principal axes
/// (keptVariance). Fails where no view lies in the range.
Result<AppearanceSample> appearanceOf(const ReflectanceField& field, const PolarRange& range = {});

/// Of all images of a measurement, which is read in as many rows as fit into `memory` bytes. Fails
/// as reading does and where no view lies in the range.
Result<AppearanceSample> appearanceOf(const BtfSource& source, std::size_t memory, const Progress& progress,
                                      const PolarRange& range = {});

/// Each texel the mean of the `side` x `side` texels around it: what a coarser level shows there.
/// Beyond the border the sample is mirrored, or repeats.
AppearanceVectors blurred(const AppearanceVectors& vectors, int side, bool repeats);

}  // namespace weft
