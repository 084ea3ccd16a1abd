#include "DrawList.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace weft {

namespace {

/// Appends the lowest bits of a number to a key.
constexpr void append(std::uint64_t& key, std::uint64_t number, unsigned bits) {
  key = key << bits | (number & ((std::uint64_t{1} << bits) - 1));
}

}  // namespace

std::uint64_t DrawOrder::key() const {
  // Distances of 0 and more, in their order.
  const std::uint32_t distance = std::bit_cast<std::uint32_t>(depth > 0.0f ? depth : 0.0f);
  std::uint64_t key = blended;
  if (blended) append(key, ~distance, 32);
  append(key, program, blended ? 5 : 8);
  append(key, material, 14);
  append(key, kind, 3);
  if (blended) append(key, page, 9);
  if (!blended) {
    append(key, page, 5);
    append(key, mesh, 14);
    append(key, distance >> 12, 19);
  }
  return key;
}

void DrawList::sort() {
  // By digits of 8 bits, the lowest first, each pass keeping the order of the one before; digits in
  // which no two keys differ are left out.
  std::uint64_t differing = 0;
  for (const DrawItem& item : items_) differing |= item.key ^ items_.front().key;
  spare_.resize(items_.size());
  for (unsigned shift = 0; shift < 64; shift += 8) {
    if ((differing >> shift & 0xff) == 0) continue;
    std::array<std::uint32_t, 256> next{};
    for (const DrawItem& item : items_) ++next[item.key >> shift & 0xff];
    for (std::uint32_t sum = 0; std::uint32_t & count : next) sum += std::exchange(count, sum);
    for (const DrawItem& item : items_) spare_[next[item.key >> shift & 0xff]++] = item;
    std::swap(items_, spare_);
  }
}

}  // namespace weft
