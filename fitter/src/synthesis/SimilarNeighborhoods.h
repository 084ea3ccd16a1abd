#pragma once

#include <cstdint>
#include <vector>

#include "SourceRegion.h"
#include "Textons.h"

namespace weft {

/// How many similar texels are kept of each: [Bosserhoff 2003]'s m.
constexpr int kSimilarTexels = 10;

/// One level of a sample's pyramid, analysed for synthesis texel by texel. Texels are indices
/// row * width + column of the region of sources alone.
struct AnalysedLayer {
  int width = 0;
  int height = 0;
  int neighborhood = 0;  ///< texels on each side; those within it of the border have no full one
  Textons textons;
  /// `[texel][kSimilarTexels]`, the most similar causal neighbourhoods, best first; where there are
  /// fewer, the texel itself.
  std::vector<std::int32_t> similar;
  /// Likewise, the probability to jump there or to one before it; the last is 1.
  std::vector<float> probability;

  bool hasNeighborhood(int x, int y) const {
    return x >= neighborhood && y >= neighborhood && x < width - neighborhood && y < height - neighborhood;
  }
};

/// The vectors are those of the region.
AnalysedLayer analyseLayer(const AppearanceVectors& vectors, int neighborhood, int textons);

}  // namespace weft
