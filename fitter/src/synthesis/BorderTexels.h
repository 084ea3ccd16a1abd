#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "weft/reflectance/Registration.h"
#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// Indices of the views in a range.
std::vector<int> viewsWithin(const std::vector<glm::vec3>& views, const PolarRange& range);

/// Whether opposite borders continue each other as well as rows and columns within do.
bool repeats(const AppearanceVectors& vectors);

/// How far a registration moves a texel at most, along x or y.
float largestShift(const Registration& registration, const std::vector<glm::vec3>& views);

/// Sets the margin for texels that move so far.
void keepFromBorder(AppearanceSample& sample, float shift);

}  // namespace weft
