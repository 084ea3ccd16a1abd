#pragma once

#include <algorithm>
#include <utility>

namespace weft {

/// Where a share of 0..1 lies between the first and last of so many values: the one before, and the
/// share of the next (shaders/table.glsl).
inline std::pair<int, float> placeInTable(float share, int count) {
  const float place = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(count - 1);
  const int before = std::min(static_cast<int>(place), count - 2);
  return {before, place - static_cast<float>(before)};
}

}  // namespace weft
