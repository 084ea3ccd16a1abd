#pragma once

#include <cstdint>
#include <iterator>
#include <map>
#include <optional>

namespace weft {

/// Gives out parts of 0..capacity.
class RangeAllocator {
 public:
  explicit RangeAllocator(std::uint32_t capacity) { free_.emplace(0, capacity); }

  /// The start of the first part that is large enough; `count` > 0.
  std::optional<std::uint32_t> take(std::uint32_t count) {
    for (auto range = free_.begin(); range != free_.end(); ++range) {
      const auto [start, size] = *range;
      if (size < count) continue;
      free_.erase(range);
      if (size > count) free_.emplace(start + count, size - count);
      return start;
    }
    return std::nullopt;
  }

  /// What take() gave.
  void giveBack(std::uint32_t start, std::uint32_t count) {
    auto after = free_.lower_bound(start);
    if (after != free_.end() && after->first == start + count) {
      count += after->second;
      after = free_.erase(after);
    }
    if (after != free_.begin()) {
      const auto before = std::prev(after);
      if (before->first + before->second == start) {
        before->second += count;
        return;
      }
    }
    free_.emplace(start, count);
  }

 private:
  std::map<std::uint32_t, std::uint32_t> free_;  ///< start -> size, none next to another
};

}  // namespace weft
