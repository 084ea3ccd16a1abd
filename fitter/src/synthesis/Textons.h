#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// The centres of clusters of texels, which stand for them, and how far they are apart
/// ([Bosserhoff 2003], section 4.1).
struct Textons {
  int count = 0;
  std::vector<std::uint16_t> ofTexel;  ///< `[row][column]`
  std::vector<float> distances;        ///< squared, `[texton][texton]`

  const float* distancesFrom(std::size_t texel) const {
    return distances.data() + std::size_t{ofTexel[texel]} * static_cast<std::size_t>(count);
  }
};

/// k-means from the start that k-means++ makes (Arthur and Vassilvitskii 2007); as many centres as
/// asked for, up to 65,535, or as there are different texels. Equal input gives equal textons, for
/// any number of threads.
Textons findTextons(const AppearanceVectors& vectors, int centres);

}  // namespace weft
