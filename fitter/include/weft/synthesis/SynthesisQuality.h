#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "weft/reflectance/CoordinateMap.h"
#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// How visible the jumps of a coordinate map are, on three levels of the pyramid: the texels
/// themselves, means of 4 x 4 and of 16 x 16 of them.
///
/// A jump is where neighbours a, b of the surface are none in the sample. It is as visible as b
/// differs from what follows a in the sample, in units of how a differs from that: 1 is as smooth
/// as the sample. Without jumps it is 0.
struct SeamVisibility {
  static constexpr std::array<int, 3> kSides{1, 4, 16};
  std::array<double, 3> mean{};  ///< over all jumps
  double jumps = 0.0;            ///< the share of all pairs of neighbours
};
SeamVisibility seamVisibility(const AppearanceSample& sample, const CoordinateMap& map);

/// How much a surface repeats itself: the autocorrelation of what it shows, over all shifts.
struct Repetition {
  /// The highest at any shift farther than a quarter of the sample, 1 for a copy.
  double correlation = 0.0;
  /// The highest of the sample itself at shifts beyond the same quarter, up to half of it: what is
  /// regular.
  double ofSample = 0.0;
  /// What repeats beyond what is regular: 0 nothing, 1 a copy.
  double beyondSample() const;
  /// The largest share of texels that show the same texel of the sample at one such shift.
  double copied = 0.0;
};
Repetition repetition(const AppearanceSample& sample, const CoordinateMap& map);

/// The sample laid side by side: what synthesis is compared with. Sizes as CoordinateMap has them.
Result<CoordinateMap> tiledMap(int width, int height, const AppearanceSample& sample);

}  // namespace weft
