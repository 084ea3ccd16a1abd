#pragma once

#include <array>
#include <glm/vec2.hpp>

namespace weft {

/// A place of a sample, whose share belongs to a sum.
struct TilingTap {
  glm::vec2 texcoord;  ///< of the sample, which repeats: 1 is the whole of it
  float share;
};

/// What is shown at a place of a surface without end that a sample covers at random: three places
/// of the sample, and its mean over all texels.
struct StochasticPlace {
  std::array<TilingTap, 3> taps;
  float meanShare;  ///< all shares add up to 1; this one is not above 0
};

/// Looks up a surface that shows a piece of the sample, chosen at random, around each vertex of a
/// grid of triangles; within a triangle its three pieces are blended.
///
/// `texcoord` is in samples, as where the sample repeats. Shares of pieces are the barycentric
/// weights over the root of their squares' sum, so that a sum has the sample's mean and, where
/// pieces have nothing to do with each other, its variance (E. Heitz, F. Neyret: High-Performance
/// By-Example Noise using a Histogram-Preserving Blending Operator, 2018, eq. 4). Pieces may lie
/// across the sample's border: without those, the middle is shown more often, and the mean of a
/// cloth moves by up to 10 % (tiling_table). The same place gives the same pieces on any machine
/// (M. Jarzynski, M. Olano: Hash Functions for GPU Rendering, 2020: pcg2d). GLSL:
/// shaders/where_stochastic.glsl.
StochasticPlace stochasticPlace(glm::vec2 texcoord);

}  // namespace weft
