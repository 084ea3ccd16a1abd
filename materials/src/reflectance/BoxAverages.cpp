#include "weft/reflectance/BoxAverages.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace weft {
BoxCover boxCover(int texel, int coarseSide, int fineSide) {
  constexpr double kNothing = 1e-9;  // of a texel: rounding
  const double from = static_cast<double>(texel) * fineSide / coarseSide;
  const double to = static_cast<double>(texel + 1) * fineSide / coarseSide;
  BoxCover cover{static_cast<int>(from + kNothing), {}};
  for (int i = cover.first; i < to && i < fineSide; ++i) {
    const double covered = std::min(to, i + 1.0) - std::max(from, static_cast<double>(i));
    if (covered > kNothing) cover.shares.push_back(static_cast<float>(covered / (to - from)));
  }
  return cover;
}

std::vector<float> boxAverages(glm::ivec2 fine, glm::ivec2 coarse, std::size_t numbers,
                               const std::function<const float*(int x, int y)>& texel) {
  const std::size_t rowNumbers = static_cast<std::size_t>(coarse.x) * numbers;
  std::vector<float> averages(static_cast<std::size_t>(coarse.y) * rowNumbers);
  tbb::parallel_for(0, coarse.y, [&](int y) {
    const BoxCover rows = boxCover(y, coarse.y, fine.y);
    for (int x = 0; x < coarse.x; ++x) {
      const BoxCover columns = boxCover(x, coarse.x, fine.x);
      float* sum =
          averages.data() + static_cast<std::size_t>(y) * rowNumbers + static_cast<std::size_t>(x) * numbers;
      for (std::size_t j = 0; j < rows.shares.size(); ++j)
        for (std::size_t i = 0; i < columns.shares.size(); ++i) {
          const float* from = texel(columns.first + static_cast<int>(i), rows.first + static_cast<int>(j));
          for (std::size_t n = 0; n < numbers; ++n) sum[n] += rows.shares[j] * columns.shares[i] * from[n];
        }
    }
  });
  return averages;
}

}  // namespace weft
