#include "weft/reflectance/LevelSum.h"

#include <algorithm>
#include <cmath>

#include "weft/core/Contract.h"

namespace weft {

float shareOfLevel(int level, float detail) {
  return std::clamp(1.0f - detail + static_cast<float>(level), 0.0f, 1.0f);
}

float detailAtDistance(float distance, int levels) {
  return std::clamp(std::log2(std::max(distance, 1.0f)), 0.0f, static_cast<float>(levels - 1));
}

void numbersOfLevels(std::span<const FieldLevel> levels, glm::vec2 place, float detail,
                     std::vector<float>& numbers) {
  WEFT_EXPECT(!levels.empty(), "there are levels");
  const FloatImage& finest = levels.front().shared;
  const glm::vec2 size(finest.width(), finest.height());
  std::vector<float> filtered;
  numbers.clear();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const FloatImage& level = levels[i].shared;
    const glm::vec2 levelSize(level.width(), level.height());
    const auto texel = filteredTexel(level, (place + 0.5f) * levelSize / size - 0.5f, filtered);
    if (i == 0) numbers.assign(texel.begin(), texel.begin() + 3);
    const float share = shareOfLevel(static_cast<int>(i), detail);
    for (const float number : texel.subspan(3)) numbers.push_back(share * number);
  }
}

}  // namespace weft
