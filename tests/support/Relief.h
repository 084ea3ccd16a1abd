#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "weft/core/Color.h"
#include "weft/core/FloatImage.h"

namespace weft::test {

/// Prints a score, for the table in docs/conventions.md.
inline double printed(const char* name, double score) {
  std::printf("[          ] %s %.3f\n", name, score);
  return score;
}

/// Pearson's correlation of two lists of the same length: -1..1.
inline double correlation(std::span<const double> a, std::span<const double> b) {
  double meanA = 0.0, meanB = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    meanA += a[i] / static_cast<double>(a.size());
    meanB += b[i] / static_cast<double>(b.size());
  }
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - meanA) * (b[i] - meanB);
    aa += (a[i] - meanA) * (a[i] - meanA);
    bb += (b[i] - meanB) * (b[i] - meanB);
  }
  return ab / std::sqrt(aa * bb);
}

/// An image of one channel "Y", from one whose first three channels are linear RGB.
inline FloatImage luminanceOf(const FloatImage& rgb) {
  FloatImage image(rgb.width(), rgb.height(), {"Y"});
  for (int y = 0; y < rgb.height(); ++y)
    for (int x = 0; x < rgb.width(); ++x)
      image.at(x, y, 0) = luminance({rgb.at(x, y, 0), rgb.at(x, y, 1), rgb.at(x, y, 2)});
  return image;
}

inline double meanOf(const FloatImage& image) {
  double sum = 0.0;
  for (const float value : image.values()) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.values().size());
}

enum class Axis { Columns, Rows };

/// The mean of every column, from left to right, or of every row, from top to bottom, over the
/// image's mean.
inline std::vector<double> profile(const FloatImage& image, Axis axis) {
  const int length = axis == Axis::Columns ? image.width() : image.height();
  std::vector<double> sums(static_cast<std::size_t>(length));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      sums[static_cast<std::size_t>(axis == Axis::Columns ? x : y)] += static_cast<double>(image.at(x, y, 0));
  const double scale =
      static_cast<double>(length) / (static_cast<double>(image.values().size()) * meanOf(image));
  for (double& sum : sums) sum *= scale;
  return sums;
}

/// Every value's mean with its two neighbours, the first being the last's.
inline std::vector<double> smoothed(const std::vector<double>& values) {
  const std::size_t n = values.size();
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i)
    result[i] = (values[(i + n - 1) % n] + values[i] + values[(i + 1) % n]) / 3.0;
  return result;
}

/// What light does to relief, as -1..1: positive where, of two pictures lit from opposite sides,
/// the one lit from growing columns (rows) is the brighter one on slopes that fall towards growing
/// columns (rows).
///
/// What is bright under both lights counts as high, because only crests are lit from both sides.
inline double flankScore(const FloatImage& litFromGrowing, const FloatImage& litFromFalling, Axis axis) {
  constexpr std::size_t kMargin = 4;  // a crop of a measurement does not repeat
  const std::vector<double> growing = profile(litFromGrowing, axis);
  const std::vector<double> falling = profile(litFromFalling, axis);
  std::vector<double> both(growing.size());
  for (std::size_t i = 0; i < both.size(); ++i) both[i] = std::min(growing[i], falling[i]);
  const std::vector<double> height = smoothed(both);
  std::vector<double> difference, descent;
  for (std::size_t i = kMargin; i < both.size() - kMargin; ++i) {
    difference.push_back(growing[i] - falling[i]);
    descent.push_back((height[i - 1] - height[i + 1]) / 2.0);
  }
  return correlation(difference, descent);
}

}  // namespace weft::test
