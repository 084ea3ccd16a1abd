#pragma once

#include "weft/core/FloatImage.h"
#include "weft/reflectance/Environment.h"
#include "weft/reflectance/OctahedralMap.h"

namespace weft {

/// An environment as shaders look it up: averages of its radiance over lobes of every direction and
/// width ([Meseth 2004] 5.2). Octahedral maps with a border, half precision, channels R, G, B,
/// divided by `scale`.
///
/// A white surface's share of a constant environment of 1 is 1 in all of them.
struct PrefilteredEnvironment {
  static constexpr OctahedralMap kLobeMap{192};
  static constexpr OctahedralMap kGlossyMap{256};
  static constexpr int kLobesPerOctave = 4;
  static constexpr int kLobeLayers = 8 * kLobesPerOctave + 1;
  static constexpr int kMomentLayers = 10;
  static constexpr int kGlossyLayers = 13;

  /// Averages over (t.l)^n, the dot product clamped at 0: layer i has n = 2^(i / kLobesPerOctave),
  /// 1 to 256. The first layer is what a white diffuse surface of normal t shows.
  FloatImage lobes;
  /// Integrals of radiance (n.l) w(l) / pi over the hemisphere of n for w = 1, x, y, z, xx, yy, zz,
  /// xy, xz, yz.
  FloatImage moments;
  /// Averages over what a GGX surface seen head-on reflects of the surroundings of t: layer i has
  /// roughness i / (kGlossyLayers - 1).
  FloatImage glossy;
  /// A power of two that keeps everything within the range of half precision.
  float scale = 1.0f;

  /// 0.5 to 3 s, whatever the environment's size. Parallel inside; equal on any number of threads.
  static PrefilteredEnvironment create(const Environment& environment);
};

}  // namespace weft
