#include "DrawList.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace weft {
namespace {

TEST(DrawList, SortsAsStandardSortDoes) {
  std::mt19937_64 random(5);
  for (const std::uint64_t mask : {~std::uint64_t{0}, std::uint64_t{0xf0f}, std::uint64_t{0}}) {
    DrawList list;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const auto bits = random() & mask;
      const DrawOrder order{.blended = bits % 2 == 1,
                            .program = static_cast<std::uint32_t>(bits >> 8 & 0xf),
                            .material = static_cast<std::uint32_t>(bits >> 16 & 0xff),
                            .mesh = static_cast<std::uint32_t>(bits >> 24 & 0xff),
                            .depth = static_cast<float>(bits >> 40)};
      list.add(order, i);
      expected.emplace_back(order.key(), i);
    }
    list.sort();
    std::stable_sort(expected.begin(), expected.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(list.items()[i].object, expected[i].second);
  }
}

TEST(DrawList, KeysPutBlendedThingsLastAndFromBackToFront) {
  const DrawOrder opaque{.program = 3, .material = 4, .depth = 5.0f};
  DrawOrder other = opaque;
  other.depth = 9.0f;
  EXPECT_LT(opaque.key(), other.key());
  other = opaque;
  other.material = 5;
  other.depth = 1.0f;
  EXPECT_LT(opaque.key(), other.key()) << "fewer changes of state before nearer things";
  const DrawOrder far{.blended = true, .program = 9, .depth = 9.0f};
  const DrawOrder near{.blended = true, .program = 1, .depth = 8.0f};
  EXPECT_LT(opaque.key(), far.key());
  EXPECT_LT(far.key(), near.key());
  EXPECT_LT(near.key(), (DrawOrder{.blended = true, .depth = -1.0f}.key()));
}

}  // namespace
}  // namespace weft
