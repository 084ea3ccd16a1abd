#include "weft/evaluation/HoldOut.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "weft/core/Contract.h"

namespace weft {

std::vector<bool> heldOut(std::span<const glm::vec3> directions, int every) {
  WEFT_EXPECT(every == 0 || every >= 2, "every is 0 or at least 2");
  std::vector<bool> result(directions.size(), false);
  if (every == 0) return result;
  std::map<int, std::vector<std::size_t>> rings;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double degrees = std::acos(std::clamp(double{directions[i].z}, -1.0, 1.0)) * 180.0 / M_PI;
    rings[static_cast<int>(std::lround(degrees / 15.0))].push_back(i);
  }
  int walked = 0;
  for (auto& [ring, members] : rings) {
    if (ring == 0 || members.size() < 2) continue;
    std::ranges::stable_sort(members, {},
                             [&](std::size_t i) { return std::atan2(directions[i].y, directions[i].x); });
    for (std::size_t i : members) result[i] = ++walked % every == 0;
  }
  return result;
}

}  // namespace weft
