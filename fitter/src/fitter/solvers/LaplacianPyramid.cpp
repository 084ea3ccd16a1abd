#include "solvers/LaplacianPyramid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/reflectance/BoxAverages.h"

namespace weft {
namespace {

/// The two coarser texels around the centre of a finer one, along an axis.
struct Between {
  std::array<int, 2> texels;
  std::array<float, 2> shares;
};

Between betweenTexels(int fine, int fineSide, int coarseSide) {
  const double place = (fine + 0.5) * coarseSide / fineSide - 0.5;
  const double low = std::floor(place);
  const auto wrapped = [&](int texel) { return (texel % coarseSide + coarseSide) % coarseSide; };
  const auto upper = static_cast<float>(place - low);
  return {{wrapped(static_cast<int>(low)), wrapped(static_cast<int>(low) + 1)}, {1.0f - upper, upper}};
}

}  // namespace

NumberImage halved(const NumberImage& fine) {
  const int width = std::max(fine.width / 2, 1), height = std::max(fine.height / 2, 1);
  return {width, height, fine.numbers,
          boxAverages({fine.width, fine.height}, {width, height}, fine.numbers,
                      [&](int x, int y) { return fine.at(x, y); })};
}

NumberImage enlarged(const NumberImage& coarse, int width, int height) {
  NumberImage fine{width, height, coarse.numbers, {}};
  fine.values.resize(fine.texels() * fine.numbers);
  tbb::parallel_for(0, height, [&](int y) {
    const Between rows = betweenTexels(y, height, coarse.height);
    for (int x = 0; x < width; ++x) {
      const Between columns = betweenTexels(x, width, coarse.width);
      float* to = fine.at(x, y);
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t i = 0; i < 2; ++i) {
          const float share = rows.shares[j] * columns.shares[i];
          const float* from = coarse.at(columns.texels[i], rows.texels[j]);
          for (std::size_t n = 0; n < fine.numbers; ++n) to[n] += share * from[n];
        }
    }
  });
  return fine;
}

std::vector<NumberImage> gaussianPyramid(NumberImage image, std::size_t fewestTexels) {
  std::vector<NumberImage> levels;
  levels.push_back(std::move(image));
  while (levels.back().texels() > std::max<std::size_t>(fewestTexels, 1))
    levels.push_back(halved(levels.back()));
  return levels;
}

}  // namespace weft
