#include "weft/chunks/State.h"

#include <atomic>
#include <bit>

namespace weft {

void State::set(unsigned slot, std::shared_ptr<const Chunk> chunk) {
  const Slot kind = slotKind(slot);
  WEFT_EXPECT(!chunk || chunk->kind() == kind, "a chunk goes into a slot of its kind");
  const std::uint64_t bit = std::uint64_t{1} << slot;
  occupied_ = chunk ? occupied_ | bit : occupied_ & ~bit;
  chunks_[slot] = std::move(chunk);
  static std::atomic<std::uint64_t> latestRevision{0};
  revision_ = ++latestRevision;
}

void State::changeFrom(GLContext& context, const State& previous) const {
  for (std::uint64_t slots = occupied_ | previous.occupied_; slots != 0; slots &= slots - 1) {
    const auto slot = static_cast<unsigned>(std::countr_zero(slots));
    const Chunk* next = at(slot);
    const Chunk* old = previous.at(slot);
    if (next == old || (next && old && *next == *old)) continue;
    if (!old)
      next->activate(context, slot);
    else if (!next)
      old->deactivate(context, slot);
    else
      next->changeFrom(context, *old, slot);
  }
}

}  // namespace weft
