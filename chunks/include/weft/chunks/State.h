#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "weft/chunks/Chunk.h"

namespace weft {

/// The chunks to draw something with, by slot. Empty slots are at GL's defaults. A value: copies
/// share the chunks.
class State {
 public:
  /// Puts a chunk of the slot's kind into it, or empties it with null.
  void set(unsigned slot, std::shared_ptr<const Chunk> chunk);
  /// Null where the slot is empty.
  const Chunk* at(unsigned slot) const { return chunks_[slot].get(); }

  /// Another one after every set(), and the same for copies alone.
  std::uint64_t revision() const { return revision_; }

  /// Changes GL from `previous`, which is active, to this. Visits only slots that one of them
  /// occupies and does nothing where both hold the same chunk or equal ones.
  void changeFrom(GLContext& context, const State& previous) const;
  /// From GL's defaults.
  void activate(GLContext& context) const { changeFrom(context, State()); }
  /// Back to GL's defaults.
  void deactivate(GLContext& context) const { State().changeFrom(context, *this); }

 private:
  void changeSlot(GLContext& context, const State& previous, unsigned slot) const;

  std::array<std::shared_ptr<const Chunk>, SlotCount> chunks_;
  /// bit slot % 64 of number slot / 64
  std::array<std::uint64_t, (SlotCount + 63) / 64> occupied_{};
  std::uint64_t revision_ = 0;
};

}  // namespace weft
