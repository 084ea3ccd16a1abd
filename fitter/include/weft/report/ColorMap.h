#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "weft/core/FloatImage.h"
#include "weft/core/Image.h"

namespace weft {

/// The colour of a share 0..1 in the map *viridis* (Smith and van der Walt 2015), stored sRGB 0..1:
/// equal steps of a value look equally large, in print without colour, too. Clamped; NaN counts as
/// 0.
glm::vec3 viridis(float share);

/// What the ends of the colour map mean.
struct ColorScale {
  float lowest = 0.0f;
  float highest = 1.0f;
  std::string label;  ///< "eps"
};

/// The first channel of an image in false colours.
Image colorMapped(const FloatImage& values, const ColorScale& scale);

}  // namespace weft
