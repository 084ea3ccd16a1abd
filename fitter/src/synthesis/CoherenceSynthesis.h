#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "SimilarNeighborhoods.h"

namespace weft {

/// [Bosserhoff 2003], section 4.2: texel by texel, the best of those that continue a neighbour and
/// of k - 1 similar to each; from the coarsest layer on, a quarter of each finer one being preset
/// and done again at last. The surface is a torus, so that the coarsest is gone through twice.
/// `layers`: from fine to coarse, each half of the one before. Returns a texel of the finest layer
/// for each texel.
std::vector<glm::ivec2> synthesizeCoherently(const std::vector<AnalysedLayer>& layers, int width, int height,
                                             int k, std::uint64_t seed);

/// A jump map (Zelinka and Garland 2002): each texel continues a neighbour at random, and at times
/// jumps to what is similar.
std::vector<glm::ivec2> synthesizeByJumps(const AnalysedLayer& layer, int width, int height,
                                          std::uint64_t seed);

}  // namespace weft
