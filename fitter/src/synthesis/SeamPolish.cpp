#include "SeamPolish.h"

#include <array>
#include <vector>

namespace weft {
namespace {

constexpr std::array<glm::ivec2, 4> kNeighbourSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

class SeamPolisher {
 public:
  SeamPolisher(const PatchSource& source, glm::ivec2 size, std::span<glm::ivec2> texels)
      : source_(source), size_(size), texels_(texels) {}

  void round() {
    for (int y = 0; y < size_.y; ++y)
      for (int x = 0; x < size_.x; ++x)
        if (const glm::ivec2 place(x, y); isAtJump(place)) improve(place);
  }

 private:
  glm::ivec2& at(glm::ivec2 p) {
    const int x = p.x < 0 ? p.x + size_.x : p.x >= size_.x ? p.x - size_.x : p.x;
    const int y = p.y < 0 ? p.y + size_.y : p.y >= size_.y ? p.y - size_.y : p.y;
    return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) +
                   static_cast<std::size_t>(x)];
  }

  bool isAtJump(glm::ivec2 place) {
    const glm::ivec2 texel = at(place);
    for (const glm::ivec2 step : kNeighbourSteps)
      if (at(place + step) != texel + step) return true;
    return false;
  }

  /// What a texel differs from what its neighbours expect; ends where it is more than `limit`.
  float cost(glm::ivec2 place, glm::ivec2 texel, float limit) {
    float sum = 0.0f;
    for (const glm::ivec2 step : kNeighbourSteps) {
      const glm::ivec2 neighbour = at(place + step), expected = neighbour - step;
      if (expected == texel) continue;
      // Both ways: what the neighbour expects here, and what this texel expects there.
      sum += source_.contains(expected) ? source_.difference(expected, texel)
                                        : source_.difference(neighbour, texel);
      if (source_.contains(texel + step)) sum += source_.difference(texel + step, neighbour);
      if (sum >= limit) break;
    }
    return sum;
  }

  void improve(glm::ivec2 place) {
    glm::ivec2& texel = at(place);
    float least = cost(place, texel, 1e30f);
    glm::ivec2 best = texel;
    const auto consider = [&](glm::ivec2 candidate) {
      if (candidate == best || !source_.contains(candidate)) return;
      if (const float value = cost(place, candidate, least); value < least) least = value, best = candidate;
    };
    for (const glm::ivec2 step : kNeighbourSteps) {
      const glm::ivec2 expected = at(place + step) - step;
      if (!source_.contains(expected)) continue;
      consider(expected);
      for (const glm::ivec2 similar : source_.similarTo(expected)) consider(similar);
    }
    texel = best;
  }

  const PatchSource& source_;
  glm::ivec2 size_;
  std::span<glm::ivec2> texels_;
};

}  // namespace

void polishSeams(const PatchSource& source, glm::ivec2 size, std::span<glm::ivec2> texels, int rounds) {
  SeamPolisher polish(source, size, texels);
  for (int i = 0; i < rounds; ++i) polish.round();
}

}  // namespace weft
