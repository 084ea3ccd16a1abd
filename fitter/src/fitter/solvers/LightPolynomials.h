#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "weft/core/FloatImage.h"

namespace weft {

/// For each channel of a light map (LightMap.h), `[row][column][channel]`, the polynomial of the
/// light whose integrals over the hemisphere, under n.l, come closest to the map's:
/// `[term][channel]` for xx, yy, xy, x, y, 1. Channels firstLinear .. endLinear - 1 have the last
/// three alone, the others of their terms are 0.
std::vector<float> lightPolynomials(std::span<const float> map, int size, std::size_t channels,
                                    std::size_t firstLinear, std::size_t endLinear);

/// The same of all maps of an image, views side by side and `levels` below each other: a row of the
/// result a map, those of the finest level first, and along it the terms; rounded to halfs.
FloatImage lightPolynomialTable(const FloatImage& maps, int levels, std::size_t firstLinear,
                                std::size_t endLinear);

}  // namespace weft
