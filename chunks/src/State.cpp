#include "weft/chunks/State.h"

#include <atomic>
#include <bit>

namespace weft {

void State::set(unsigned slot, std::shared_ptr<const Chunk> chunk) {
  const Slot kind = slotKind(slot);
  WEFT_EXPECT(!chunk || chunk->kind() == kind, "a chunk goes into a slot of its kind");
  const std::uint64_t bit = std::uint64_t{1} << slot % 64;
  std::uint64_t& occupied = occupied_[slot / 64];
  occupied = chunk ? occupied | bit : occupied & ~bit;
  chunks_[slot] = std::move(chunk);
  static std::atomic<std::uint64_t> latestRevision{0};
  revision_ = ++latestRevision;
}

void State::changeFrom(GLContext& context, const State& previous) const {
  for (unsigned first = 0; first < SlotCount; first += 64) {
    std::uint64_t slots = occupied_[first / 64] | previous.occupied_[first / 64];
    for (; slots != 0; slots &= slots - 1)
      changeSlot(context, previous, first + static_cast<unsigned>(std::countr_zero(slots)));
  }
}

void State::changeSlot(GLContext& context, const State& previous, unsigned slot) const {
  const Chunk* next = at(slot);
  const Chunk* old = previous.at(slot);
  if (next == old || (next && old && *next == *old)) return;
  if (!old)
    next->activate(context, slot);
  else if (!next)
    old->deactivate(context, slot);
  else
    next->changeFrom(context, *old, slot);
}

}  // namespace weft
