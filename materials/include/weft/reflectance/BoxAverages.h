#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace weft {

/// What coarser texels are on average, where each covers a rectangle of finer ones, whole or in
/// part: `[row][column][number]`. `texel(x, y)` points to the numbers of a finer one. The sizes of
/// both are columns and rows.
std::vector<float> boxAverages(glm::ivec2 fine, glm::ivec2 coarse, std::size_t numbers,
                               const std::function<const float*(int x, int y)>& texel);

}  // namespace weft
