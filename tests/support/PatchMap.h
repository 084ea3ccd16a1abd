#pragma once

#include <random>
#include <vector>

#include "TestSupport.h"
#include "weft/reflectance/CoordinateMap.h"

namespace weft::test {

/// A surface of square patches from anywhere in the sample, which may run over its edges: it jumps
/// between all patches, and nowhere else.
inline CoordinateMap patchMap(glm::ivec2 size, glm::ivec2 sample, int patch, unsigned seed = 1) {
  std::mt19937 random(seed);
  const glm::ivec2 patches = (size + patch - 1) / patch;
  std::vector<glm::ivec2> corners;
  for (int i = 0; i < patches.x * patches.y; ++i) {
    const auto column = static_cast<int>(random() % static_cast<unsigned>(sample.x));
    corners.emplace_back(column, static_cast<int>(random() % static_cast<unsigned>(sample.y)));
  }
  std::vector<glm::u16vec2> texels;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      const glm::ivec2 corner = corners[static_cast<std::size_t>(y / patch * patches.x + x / patch)];
      texels.emplace_back((corner + glm::ivec2(x % patch, y % patch)) % sample);
    }
  return valueOf(CoordinateMap::create(size.x, size.y, sample.x, sample.y, std::move(texels), "sample"));
}

}  // namespace weft::test
