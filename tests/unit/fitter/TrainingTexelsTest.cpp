#include "solvers/TrainingTexels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace weft {
namespace {

int contained(const TrainingTexels& texels, int firstX, int endX, int firstY, int endY) {
  int count = 0;
  for (int y = firstY; y < endY; ++y)
    for (int x = firstX; x < endX; ++x) count += texels.contains(x, y) ? 1 : 0;
  return count;
}

TEST(TrainingTexels, AreAsManyAsSaid) {
  for (const auto& [width, height] : {std::pair{256, 256}, {300, 7}, {1, 1}, {64, 64}}) {
    const TrainingTexels texels(width, height, 6561);
    EXPECT_EQ(texels.count(), std::min<std::size_t>(6000, static_cast<std::size_t>(width * height)));
    EXPECT_EQ(contained(texels, 0, width, 0, height), static_cast<int>(texels.count()));
  }
}

TEST(TrainingTexels, AreFewerWhereTheyHaveManyPairs) {
  EXPECT_EQ(TrainingTexels(256, 256, 151 * 151).count(), 40'000'000u / (151 * 151));
  EXPECT_EQ(TrainingTexels(256, 256, 100'000'000).count(), 1u);
  EXPECT_EQ(TrainingTexels(0, 0, 81).count(), 0u);
  EXPECT_FALSE(TrainingTexels(0, 0, 81).contains(0, 0));
}

TEST(TrainingTexels, LieEverywhere) {
  const TrainingTexels texels(256, 256, 6561);
  for (int y = 0; y < 256; y += 32)
    for (int x = 0; x < 256; x += 32)
      EXPECT_NEAR(contained(texels, x, x + 32, y, y + 32), 6000.0 / 64.0, 40.0);
  for (int x = 0; x < 256; ++x) EXPECT_NEAR(contained(texels, x, x + 1, 0, 256), 6000.0 / 256.0, 23.0);
}

TEST(SpreadLights, TakesSomeOfEveryRing) {
  const std::vector<std::size_t> chosen = spreadLights(81, 12);
  ASSERT_EQ(chosen.size(), 12u);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  // the rings of UBO2003 begin here
  constexpr std::array<std::size_t, 7> rings{0, 1, 7, 19, 37, 57, 81};
  for (std::size_t ring = 1; ring + 1 < rings.size(); ++ring)
    EXPECT_TRUE(std::any_of(chosen.begin(), chosen.end(),
                            [&](std::size_t i) { return i >= rings[ring] && i < rings[ring + 1]; }));
}

TEST(SpreadLights, TakesAllOfFew) {
  EXPECT_EQ(spreadLights(3, 12), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(spreadLights(1, 12), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(spreadLights(0, 12).empty());
}

}  // namespace
}  // namespace weft
