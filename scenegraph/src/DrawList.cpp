#include "DrawList.h"

#include <algorithm>
#include <bit>

namespace weft {

namespace {

/// Distances of 0 and more, in their order.
std::uint64_t depthBits(float depth) {
  return std::bit_cast<std::uint32_t>(std::max(depth, 0.0f));
}

}  // namespace

void DrawList::add(const Geometry& geometry, const State& state, const glm::mat4& model, float depth) {
  // Numbers of this frame, so that the order does not depend on addresses. What does not fit its bits only
  // costs state changes.
  const auto number = [this](const void* object) {
    return numbers_.try_emplace(object, numbers_.size()).first->second;
  };
  const std::uint64_t program = number(state.at(ProgramSlot)) & 0x7ff;
  const std::uint64_t material = number(&state) & 0xfffff;
  const std::uint64_t order = program << 20 | material;
  const std::uint64_t key = state.at(BlendSlot)
                                ? std::uint64_t{1} << 63 | (~depthBits(depth) & 0xffffffff) << 31 | order
                                : order << 32 | depthBits(depth);
  items_.push_back({key, &geometry, &state, model});
}

void DrawList::sort() {
  std::stable_sort(items_.begin(), items_.end(),
                   [](const DrawItem& a, const DrawItem& b) { return a.key < b.key; });
}

}  // namespace weft
