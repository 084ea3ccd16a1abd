#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace weft {

/// Some numbers a texel, `[row][column][number]`, of a surface that repeats.
struct NumberImage {
  int width = 0;
  int height = 0;
  std::size_t numbers = 0;
  std::vector<float> values{};

  std::size_t texels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  float* at(int x, int y) { return values.data() + indexOf(x, y); }
  const float* at(int x, int y) const { return values.data() + indexOf(x, y); }

 private:
  std::size_t indexOf(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           numbers;
  }
};

/// The next coarser level: sides halved, rounded down, at least 1; averages of the boxes that
/// coarser texels cover.
NumberImage halved(const NumberImage& fine);

/// A coarser level as it is seen at the texels of a finer one of that size: bilinear, as GL filters
/// it.
NumberImage enlarged(const NumberImage& coarse, int width, int height);

/// The image, and coarser ones until there are at most `fewestTexels`.
std::vector<NumberImage> gaussianPyramid(NumberImage image, std::size_t fewestTexels);

}  // namespace weft
