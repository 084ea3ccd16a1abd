#include "weft/evaluation/HoldOut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "MemoryBtf.h"

namespace weft {
namespace {

TEST(HoldOut, LeavesAboutEveryNthOutButNeverThePoleOrARing) {
  const std::vector<glm::vec3> directions = test::ubo2003Sampling();
  for (int every : {2, 3, 8, 10, 80}) {
    const std::vector<bool> left = heldOut(directions, every);
    ASSERT_EQ(left.size(), directions.size());
    EXPECT_EQ(std::ranges::count(left, true), 80 / every);
    EXPECT_FALSE(left[0]) << "the pole";
    std::map<long, int> kept;
    for (std::size_t i = 0; i < left.size(); ++i)
      kept[std::lround(1000.0f * directions[i].z)] += left[i] ? 0 : 1;
    EXPECT_EQ(kept.size(), 6u);
    for (const auto& [ring, count] : kept) EXPECT_GT(count, 0) << ring;
  }
}

TEST(HoldOut, TakesSomeOfEveryLargeRing) {
  const std::vector<glm::vec3> directions = test::ubo2003Sampling();
  const std::vector<bool> left = heldOut(directions, 8);
  std::map<long, int> out;
  for (std::size_t i = 0; i < left.size(); ++i)
    if (left[i]) ++out[std::lround(1000.0f * directions[i].z)];
  EXPECT_EQ(out.size(), 4u);  // the ring of six comes before the first eighth direction
}

TEST(HoldOut, NothingOrTooFewIsPossible) {
  const std::vector<glm::vec3> directions = test::ubo2003Sampling();
  EXPECT_EQ(std::ranges::count(heldOut(directions, 0), true), 0);
  const std::vector<glm::vec3> three{{0, 0, 1}, directions[20], {1, 0, 0}};
  EXPECT_EQ(std::ranges::count(heldOut(three, 2), true), 0) << "each is alone in its ring";
}

}  // namespace
}  // namespace weft
