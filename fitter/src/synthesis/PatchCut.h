#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace weft {

/// At which sides a patch overlaps what is there.
struct Overlap {
  bool left = false, top = false, right = false, bottom = false;
  int width = 0;  ///< of the strips, texels
};

/// Which texels of a patch are taken: those within the cheapest paths through the strips where it
/// overlaps what is there.
struct PatchCut {
  std::vector<std::uint8_t> taken;  ///< `[row][column]`
  double cost = 0.0;                ///< the sum of what differs along the paths
};

/// `difference`: of a texel of the patch, in a strip, from what is there.
PatchCut cutPatch(glm::ivec2 size, const Overlap& overlap,
                  const std::function<float(int x, int y)>& difference);

}  // namespace weft
