#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace weft {

/// The factor of a linear luminance's residual that makes least squares spend its effort as a display shows
/// it: the slope of the display's encoding at the sample, levelled off in the dark, where the slope has no
/// bound.
///
/// Plain least squares on linear values spends everything on highlights; light, on the other hand, adds up
/// only in linear values.
float displayWeight(float luminance);

/// displayWeight() of every sample.
std::vector<float> displayWeights(std::span<const float> luminance);

/// The base colour c of a texel for which c Y looks closest to its linear RGB samples: sum(w RGB Y) / sum(w
/// Y^2) with the squares of the display's weights; white for a black texel. Its luminance is 1.
glm::vec3 fitBaseColor(std::span<const glm::vec3> samples);

/// What to fit, so that the model times the base colour comes close to the sample in linear *and* in
/// displayed luminance.
///
/// Where a sample's hue differs from the base colour's, no number gives both: this is the geometric mean of
/// the two that give one each (on the measured wool displayed luminance gains 20 % of its error, linear
/// luminance loses 5 %).
float targetLuminance(glm::vec3 sample, glm::vec3 baseColor);

}  // namespace weft
