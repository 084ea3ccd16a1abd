#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "weft/core/FloatImage.h"

namespace weft {

/// What red, green, blue and white of a picture are, as CIE x and y.
struct ColorPrimaries {
  glm::dvec2 red{0.64, 0.33};  ///< Rec. 709
  glm::dvec2 green{0.30, 0.60};
  glm::dvec2 blue{0.15, 0.06};
  glm::dvec2 white{0.3127, 0.3290};
};

/// Linear RGB of these primaries to Rec. 709; white becomes white (Bradford). The identity where
/// they are those of Rec. 709 to three digits; none where they span no colours.
std::optional<glm::mat3> toRec709(const ColorPrimaries& primaries);

/// Multiplies the channels R, G, B, which the image has, in this order and no others.
void transformColors(FloatImage& image, const glm::mat3& matrix);

}  // namespace weft
