#include "weft/core/StructuralSimilarity.h"

#include <gtest/gtest.h>

#include <numeric>

#include "PatternPictures.h"

namespace weft {
namespace {

double meanSimilarity(const FloatImage& a, const FloatImage& b) {
  const FloatImage map = structuralSimilarity(a, b);
  const auto values = map.values();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// scikit-image 0.19.3 of the same bytes / 255, weighted (.2126, .7152, .0722):
// skimage.metrics.structural_similarity(a, b, gaussian_weights=True, sigma=1.5,
//                                       use_sample_covariance=False, data_range=1.0, full=True)
TEST(StructuralSimilarity, IsWhatScikitImageSays) {
  EXPECT_NEAR(meanSimilarity(test::wildPicture(0), test::wildPicture(9)), 0.6158381661, 1e-6);
  EXPECT_NEAR(meanSimilarity(test::smoothPicture(0), test::smoothPicture(1)), 0.8764465781, 1e-6);
  const FloatImage map = structuralSimilarity(test::wildPicture(0), test::wildPicture(9));
  EXPECT_EQ(map.width(), 30);
  EXPECT_EQ(map.height(), 22);
  EXPECT_NEAR(map.at(20 - 5, 16 - 5, 0), 0.9237548892, 1e-6);
}

TEST(StructuralSimilarity, OfAPictureWithItselfIsOne) {
  EXPECT_NEAR(meanSimilarity(test::wildPicture(3), test::wildPicture(3)), 1.0, 1e-7);
}

}  // namespace
}  // namespace weft
