#pragma once

#include "weft/core/FloatImage.h"

namespace weft {

/// The side of the windows in which structuralSimilarity() compares.
constexpr int kSimilarityWindow = 11;

/// The structural similarity (SSIM) of two pictures as [Wang 2004] define it: of luminance of
/// stored values of 0 to 1, in windows of 11 x 11 pixels with the weights of a Gaussian of
/// deviation 1.5.
///
/// Both have one size, at least one window's, and channels R, G and B first. One channel, 1 where
/// the pictures are alike; `(width - 10) x (height - 10)`: of the windows that lie in the pictures.
FloatImage structuralSimilarity(const FloatImage& a, const FloatImage& b);

}  // namespace weft
