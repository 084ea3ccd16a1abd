#include "PatchCut.h"

#include <algorithm>
#include <limits>

namespace weft {
namespace {

/// A path along a strip: of each of `length` steps, from which place across on the patch is taken.
struct CutPath {
  std::vector<int> first;
  float cost = 0.0f;
};

/// The cheapest path by dynamic programming over `differences[step][across]`. A path between two
/// texels costs what differs at both.
CutPath cheapestPath(const std::vector<float>& differences, int length, int width) {
  const auto at = [&](int step, int across) {
    return differences[static_cast<std::size_t>(step * width + across)];
  };
  std::vector<float> costs(static_cast<std::size_t>(length * width), std::numeric_limits<float>::infinity());
  std::vector<std::int8_t> moves(costs.size());
  const auto cost = [&](int step, int across) -> float& {
    return costs[static_cast<std::size_t>(step * width + across)];
  };
  for (int step = 0; step < length; ++step)
    for (int across = 1; across < width; ++across) {
      float best = step == 0 ? 0.0f : std::numeric_limits<float>::infinity();
      for (int move = -1; step > 0 && move <= 1; ++move) {
        const int from = across + move;
        if (from < 1 || from >= width) continue;
        // A path that moves also runs between two steps.
        const float along =
            move == 0 ? 0.0f : at(step - 1, std::min(from, across)) + at(step, std::min(from, across));
        if (cost(step - 1, from) + along < best) {
          best = cost(step - 1, from) + along;
          moves[static_cast<std::size_t>(step * width + across)] = static_cast<std::int8_t>(move);
        }
      }
      cost(step, across) = best + at(step, across - 1) + at(step, across);
    }
  CutPath path;
  path.first.resize(static_cast<std::size_t>(length));
  int across = 1;
  for (int i = 2; i < width; ++i)
    if (cost(length - 1, i) < cost(length - 1, across)) across = i;
  path.cost = cost(length - 1, across);
  for (int step = length - 1; step >= 0; --step) {
    path.first[static_cast<std::size_t>(step)] = across;
    across += moves[static_cast<std::size_t>(step * width + across)];
  }
  return path;
}

/// A strip at one side: `across` counts from what is there to the patch.
struct CutStrip {
  bool isVertical;
  bool isReversed;  ///< right or bottom
};

glm::ivec2 stripTexel(const CutStrip& strip, glm::ivec2 size, int step, int across) {
  if (strip.isVertical) return {strip.isReversed ? size.x - 1 - across : across, step};
  return {step, strip.isReversed ? size.y - 1 - across : across};
}

void cutAlong(const CutStrip& strip, glm::ivec2 size, int width,
              const std::function<float(int x, int y)>& difference, PatchCut& cut) {
  const int length = strip.isVertical ? size.y : size.x;
  std::vector<float> differences(static_cast<std::size_t>(length * width));
  for (int step = 0; step < length; ++step)
    for (int across = 0; across < width; ++across) {
      const glm::ivec2 texel = stripTexel(strip, size, step, across);
      differences[static_cast<std::size_t>(step * width + across)] = difference(texel.x, texel.y);
    }
  const CutPath path = cheapestPath(differences, length, width);
  cut.cost += double{path.cost};
  for (int step = 0; step < length; ++step)
    for (int across = 0; across < path.first[static_cast<std::size_t>(step)]; ++across) {
      const glm::ivec2 texel = stripTexel(strip, size, step, across);
      cut.taken[static_cast<std::size_t>(texel.y * size.x + texel.x)] = 0;
    }
}

}  // namespace

PatchCut cutPatch(glm::ivec2 size, const Overlap& overlap,
                  const std::function<float(int x, int y)>& difference) {
  PatchCut cut;
  cut.taken.assign(static_cast<std::size_t>(size.x * size.y), 1);
  if (overlap.left) cutAlong({true, false}, size, overlap.width, difference, cut);
  if (overlap.right) cutAlong({true, true}, size, overlap.width, difference, cut);
  if (overlap.top) cutAlong({false, false}, size, overlap.width, difference, cut);
  if (overlap.bottom) cutAlong({false, true}, size, overlap.width, difference, cut);
  return cut;
}

}  // namespace weft
