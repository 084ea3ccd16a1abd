#include "weft/core/FlipDifference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "PatternPictures.h"

namespace weft {
namespace {

double meanOf(const FloatImage& map) {
  const auto values = map.values();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

FloatImage pictureOf(std::array<int, 3> rgb) {
  return test::pictureOfBytes([&](int, int, int c) { return rgb[static_cast<std::size_t>(c)]; });
}

// What the authors' program says (NVlabs/flip, python/flip_api.py of 2021, compute_ldrflip(), with
// doubles and scipy.ndimage.correlate(mode="nearest") for OpenCV's filter) of the same bytes / 255.
TEST(FlipDifference, IsWhatItsAuthorsProgramSays) {
  const FloatImage wild = flipDifference(test::wildPicture(0), test::wildPicture(9));
  EXPECT_NEAR(meanOf(wild), 0.4527453362, 1e-5);
  EXPECT_NEAR(*std::ranges::max_element(wild.values()), 0.9739049975, 1e-5);
  EXPECT_NEAR(wild.at(0, 0, 0), 0.2730094412, 1e-5);
  EXPECT_NEAR(wild.at(20, 16, 0), 0.3354011632, 1e-5);
  const FloatImage smooth = flipDifference(test::smoothPicture(0), test::smoothPicture(1));
  EXPECT_NEAR(meanOf(smooth), 0.1626736161, 1e-5);
  EXPECT_NEAR(smooth.at(0, 0, 0), 0.0182656793, 1e-5);
}

TEST(FlipDifference, DependsOnHowFarTheScreenIs) {
  EXPECT_NEAR(meanOf(flipDifference(test::wildPicture(0), test::wildPicture(9), 20.0)), 0.5045739755, 1e-5);
  EXPECT_NEAR(meanOf(flipDifference(test::smoothPicture(0), test::smoothPicture(1), 20.0)), 0.1475859536,
              1e-5);
}

// Green and blue are the colours that are farthest apart.
TEST(FlipDifference, OfColoursGoesFromZeroToOne) {
  EXPECT_NEAR(meanOf(flipDifference(pictureOf({0, 255, 0}), pictureOf({0, 0, 255}))), 1.0, 1e-6);
  EXPECT_NEAR(meanOf(flipDifference(pictureOf({0, 0, 0}), pictureOf({255, 255, 255}))), 0.9673797634, 1e-5);
  EXPECT_EQ(meanOf(flipDifference(test::wildPicture(3), test::wildPicture(3))), 0.0);
}

}  // namespace
}  // namespace weft
