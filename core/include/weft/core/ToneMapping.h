#pragma once

#include <glm/vec3.hpp>

#include "weft/core/FloatImage.h"

namespace weft {

/// How linear radiance becomes what a display can show, before it is encoded.
enum class ToneCurve {
  None,  ///< as it is; what exceeds 1 is cut off when it is encoded
  /// As it is up to 0.8; where the brightest channel p exceeds that, all channels are scaled so
  /// that it becomes 1 - 0.04 / (p - 0.6), which goes on with the same slope and never reaches 1,
  /// and fade to white by the share 1 - 1 / (1 + 0.15 (p - new p)).
  Soft,
};

/// Linear RGB in 0..1 for ToneCurve::Soft; NaN becomes 0.
glm::vec3 toneMapped(glm::vec3 radiance, ToneCurve curve);

/// Multiplies the channels R, G, B by 2^stops, then maps them. Other channels stay.
void expose(FloatImage& image, float stops, ToneCurve curve);

}  // namespace weft
