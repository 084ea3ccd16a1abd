#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/core/Color.h"

namespace weft {

/// What a TexelFitter is given: values, and the factors of their residuals.
struct FitTargets {
  std::vector<float> values;
  std::vector<float> weights;
};

/// The factor of a linear value's residual that makes least squares spend its effort as a display
/// shows it: the slope of the display's encoding at the sample, levelled off in the dark, where the
/// slope has no bound.
///
/// Plain least squares on linear values spends everything on highlights; light, on the other hand,
/// adds up only in linear values.
float displayWeight(float value);

/// displayWeight() of every value.
std::vector<float> displayWeights(std::span<const float> values);

/// The base colour c of a texel for which c Y looks closest to its linear RGB samples: sum(w RGB Y)
/// / sum(w Y^2) with the squares of the display's weights; white for a black texel. Its luminance
/// is 1.
glm::vec3 fitBaseColor(std::span<const glm::vec3> samples);
/// The same without weights, for a literal fit of stored values.
glm::vec3 fitPlainBaseColor(std::span<const glm::vec3> samples);

/// What to fit, so that the model times the base colour comes close to linear samples in linear
/// *and* in displayed luminance; `displayed` are the samples in the display's encoding.
///
/// Where a sample's hue differs from the base colour's, no number gives both: this is the geometric
/// mean of the two that give one each (on the measured wool displayed luminance gains 20 % of its
/// error, linear luminance loses 5 %).
FitTargets luminanceTargets(std::span<const glm::vec3> linear, std::span<const glm::vec3> displayed,
                            Encoding display, glm::vec3 baseColor);
/// The luminance of stored values, all of one weight.
FitTargets plainLuminanceTargets(std::span<const glm::vec3> stored);
/// One channel as multiples of the base colour's; `weighted` by the display's weights.
FitTargets channelTargets(std::span<const glm::vec3> samples, int channel, glm::vec3 baseColor,
                          bool weighted);

}  // namespace weft
