#pragma once

#include <functional>
#include <span>
#include <vector>

#include "weft/core/FloatImage.h"

namespace weft {

/// One channel of numbers, for filters: `values[row][column]`.
struct ImagePlane {
  int width = 0;
  int height = 0;
  std::vector<double> values;
};

/// What `value` makes of each texel of an image's first layer.
ImagePlane planeOf(const FloatImage& image, const std::function<double(std::span<const float>)>& value);

/// Correlates with `kernelX[column] kernelY[row]`, both of an odd number of values, the middle one
/// for the pixel itself. Beyond an edge its pixels are repeated.
ImagePlane filtered(const ImagePlane& plane, std::span<const double> kernelX,
                    std::span<const double> kernelY);

/// exp(-x^2 / (2 deviation^2)) for x from -radius to radius, scaled to a sum of 1.
std::vector<double> gaussianKernel(int radius, double deviation);

}  // namespace weft
