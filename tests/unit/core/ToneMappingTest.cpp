#include "weft/core/ToneMapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weft::test {
namespace {

TEST(ToneMapping, SoftLeavesMostAndEndsBelowOne) {
  EXPECT_EQ(toneMapped({0.1f, 0.5f, 0.8f}, ToneCurve::Soft), glm::vec3(0.1f, 0.5f, 0.8f));
  float before = 0.8f;
  for (float value = 0.81f; value < 1e6f; value *= 1.1f) {
    const float shown = toneMapped(glm::vec3(value), ToneCurve::Soft).x;
    EXPECT_GE(shown, before);
    EXPECT_LE(shown, 1.0f);
    before = shown;
  }
  // The slope goes on, and bright colours fade to white.
  EXPECT_NEAR(toneMapped(glm::vec3(0.801f), ToneCurve::Soft).x, 0.801f, 1e-4f);
  const glm::vec3 red = toneMapped({50.0f, 5.0f, 0.0f}, ToneCurve::Soft);
  EXPECT_GT(red.x, red.y);
  EXPECT_GT(red.z, 0.8f);
}

TEST(ToneMapping, NothingMakesANumberThatIsNone) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  for (const float value : {std::nanf(""), kInfinite, -kInfinite, -1.0f, 1e38f}) {
    const glm::vec3 shown = toneMapped({value, 0.5f, 0.0f}, ToneCurve::Soft);
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(shown[c] >= 0.0f && shown[c] <= 1.0f) << value;
  }
}

TEST(ToneMapping, ExposureIsInStopsAndLeavesAlpha) {
  FloatImage image(1, 1, {"R", "G", "B", "A"});
  for (int c = 0; c < 4; ++c) image.at(0, 0, c) = 0.25f;
  expose(image, 1.0f, ToneCurve::None);
  EXPECT_EQ(image.at(0, 0, 0), 0.5f);
  EXPECT_EQ(image.at(0, 0, 3), 0.25f);
}

}  // namespace
}  // namespace weft::test
