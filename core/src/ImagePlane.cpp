#include "ImagePlane.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft {
namespace {

/// Correlates along lines of `count` values `step` apart, of which the first ones begin `begin`
/// apart.
void filterLines(const std::vector<double>& from, std::vector<double>& to, int lines, std::size_t begin,
                 int count, std::size_t step, std::span<const double> kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  std::vector<double> line(static_cast<std::size_t>(count) + 2 * static_cast<std::size_t>(radius));
  for (int l = 0; l < lines; ++l) {
    const std::size_t start = static_cast<std::size_t>(l) * begin;
    for (int i = -radius; i < count + radius; ++i)
      line[static_cast<std::size_t>(i + radius)] =
          from[start + static_cast<std::size_t>(std::clamp(i, 0, count - 1)) * step];
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      to[start + i * step] = std::inner_product(kernel.begin(), kernel.end(), line.data() + i, 0.0);
  }
}

}  // namespace

ImagePlane planeOf(const FloatImage& image, const std::function<double(std::span<const float>)>& value) {
  ImagePlane plane{image.width(), image.height(), {}};
  plane.values.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) plane.values.push_back(value(image.texel(x, y)));
  return plane;
}

ImagePlane filtered(const ImagePlane& plane, std::span<const double> kernelX,
                    std::span<const double> kernelY) {
  const auto width = static_cast<std::size_t>(plane.width);
  ImagePlane rows = plane, result = plane;
  filterLines(plane.values, rows.values, plane.height, width, plane.width, 1, kernelX);
  filterLines(rows.values, result.values, plane.width, 1, plane.height, width, kernelY);
  return result;
}

std::vector<double> gaussianKernel(int radius, double deviation) {
  std::vector<double> kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(std::exp(-0.5 * x * x / (deviation * deviation)));
  const double sum = std::accumulate(kernel.begin(), kernel.end(), 0.0);
  for (double& value : kernel) value /= sum;
  return kernel;
}

}  // namespace weft
