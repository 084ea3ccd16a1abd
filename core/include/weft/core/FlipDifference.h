#pragma once

#include "weft/core/FloatImage.h"

namespace weft {

/// Pixels to a degree of what the eye sees: a screen of 3840 pixels, 0.7 m wide and 0.7 m away.
constexpr double kFlipPixelsPerDegree = 67.0206;

/// How different two pictures look when one flips from one to the other: the LDR-FLIP of
/// [Andersson 2020].
///
/// Of stored (sRGB) values of 0 to 1; both have one size and channels R, G and B first. One
/// channel, 0 (alike) to 1.
FloatImage flipDifference(const FloatImage& a, const FloatImage& b,
                          double pixelsPerDegree = kFlipPixelsPerDegree);

}  // namespace weft
