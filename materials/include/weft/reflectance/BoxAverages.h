#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace weft {

/// Which finer texels a coarser one covers along an axis, whole or in part, and how much of each;
/// the shares add up to 1.
struct BoxCover {
  int first = 0;
  std::vector<float> shares;
};
BoxCover boxCover(int texel, int coarseSide, int fineSide);

/// What coarser texels are on average, where each covers a rectangle of finer ones, whole or in
/// part: `[row][column][number]`. `texel(x, y)` points to the numbers of a finer one. The sizes of
/// both are columns and rows.
std::vector<float> boxAverages(glm::ivec2 fine, glm::ivec2 coarse, std::size_t numbers,
                               const std::function<const float*(int x, int y)>& texel);

}  // namespace weft
