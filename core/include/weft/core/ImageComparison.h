#pragma once

#include "weft/core/FloatImage.h"

namespace weft {

/// How far two images of the same size and channels are apart, over all channels and layers.
struct ImageComparison {
  /// largest absolute difference; infinite where one is not finite and the other is
  float maximum = 0.0f;
  double mean = 0.0;  ///< mean absolute difference
  /// share of pixels in which some channel differs by more than the tolerance
  double failingShare = 0.0;
  double rootMeanSquare = 0.0;  ///< of the differences
};

/// Compares; images of different shape are infinitely far apart.
ImageComparison compareImages(const FloatImage& actual, const FloatImage& expected, float tolerance = 0.0f);

/// |actual - expected| times `gain`, for people to look at. The images must have the same shape.
FloatImage differenceImage(const FloatImage& actual, const FloatImage& expected, float gain = 1.0f);

}  // namespace weft
