#pragma once

#include <memory>

#include "weft/reflectance/Environment.h"
#include "weft/reflectance/PrefilteredEnvironment.h"
#include "weft/scenegraph/EnvironmentLight.h"

namespace weft {

/// How materials with lobes ask an environment.
enum class LobeLookup {
  /// Each lobe's part above the horizon, times n.l, as one lobe (lobeAboveHorizon()), between
  /// exponents.
  Fitted,
  /// [Meseth 2004] 5.2: lobes as they are, times n.t, their exponents rounded to 2^(i/2), i =
  /// 0..10, in parabolic maps of a rectangle texture. For comparisons.
  Paper,
};

/// Light from a picture, for all materials of a scene: the textures of shaders/environment.glsl,
/// and the picture as background. Touches no GL. What it is made from may go.
std::shared_ptr<EnvironmentLight> makeEnvironmentLight(const Environment& environment,
                                                       const PrefilteredEnvironment& prefiltered,
                                                       LobeLookup lookup = LobeLookup::Fitted);

}  // namespace weft
