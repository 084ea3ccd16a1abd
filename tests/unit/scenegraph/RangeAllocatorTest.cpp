#include "RangeAllocator.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace weft {
namespace {

TEST(RangeAllocator, GivesOutWhatIsFreeAndJoinsWhatComesBack) {
  constexpr std::uint32_t kCapacity = 500;
  RangeAllocator allocator(kCapacity);
  std::vector<bool> taken(kCapacity);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;
  std::mt19937 generator(1);
  const auto random = [&] { return static_cast<std::uint32_t>(generator()); };
  for (int round = 0; round < 5000; ++round) {
    const std::uint32_t count = random() % 20 + 1;
    if (const auto start = random() % 3 != 0 ? allocator.take(count) : std::nullopt) {
      ASSERT_LE(*start + count, kCapacity);
      for (std::uint32_t i = *start; i < *start + count; ++i) {
        ASSERT_FALSE(taken[i]);
        taken[i] = true;
      }
      ranges.emplace_back(*start, count);
    } else if (!ranges.empty()) {
      std::swap(ranges[random() % ranges.size()], ranges.back());
      const auto [first, size] = ranges.back();
      ranges.pop_back();
      allocator.giveBack(first, size);
      for (std::uint32_t i = first; i < first + size; ++i) taken[i] = false;
    }
  }
  for (const auto& [first, size] : ranges) allocator.giveBack(first, size);
  EXPECT_EQ(allocator.take(kCapacity), 0u) << "all of it is one part again";
  EXPECT_EQ(allocator.take(1), std::nullopt);
}

}  // namespace
}  // namespace weft
