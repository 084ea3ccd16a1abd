#include "weft/reflectance/StochasticTiling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>
#include <vector>

namespace weft::test {
namespace {

constexpr int kSide = 64;

// Grey noise of mean .5 and variance 1/12, texel by texel.
std::vector<float> noise() {
  std::mt19937 random(2018);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<float> texels(kSide * kSide);
  for (float& texel : texels) texel = unit(random);
  return texels;
}

float meanOf(const std::vector<float>& values) {
  double sum = 0.0;
  for (const float value : values) sum += value;
  return static_cast<float>(sum / static_cast<double>(values.size()));
}

float shownAt(const std::vector<float>& texels, float mean, glm::vec2 texcoord) {
  const StochasticPlace place = stochasticPlace(texcoord);
  float value = place.meanShare * mean;
  for (const TilingTap& tap : place.taps) {
    const glm::ivec2 texel = glm::floor(glm::fract(tap.texcoord) * static_cast<float>(kSide));
    value += tap.share * texels[static_cast<std::size_t>(texel.y * kSide + texel.x)];
  }
  return value;
}

// Of the texels of a square of surface, so many samples wide.
std::vector<float> surfaceOf(const std::vector<float>& texels, int samples) {
  const float mean = meanOf(texels);
  std::vector<float> surface;
  for (int y = 0; y < samples * kSide; ++y)
    for (int x = 0; x < samples * kSide; ++x)
      surface.push_back(shownAt(texels, mean, (glm::vec2(x, y) + 0.5f) / static_cast<float>(kSide)));
  return surface;
}

TEST(StochasticTiling, SharesKeepMeanAndVariance) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1000.0f, 1000.0f);
  for (int i = 0; i < 10000; ++i) {
    const StochasticPlace found = stochasticPlace({place(random), place(random)});
    float sum = found.meanShare, squares = 0.0f;
    for (const TilingTap& tap : found.taps) {
      sum += tap.share;
      squares += tap.share * tap.share;
      EXPECT_GE(tap.share, 0.0f);
    }
    EXPECT_NEAR(sum, 1.0f, 1e-5f);
    EXPECT_NEAR(squares, 1.0f, 1e-5f);
    EXPECT_LE(found.meanShare, 1e-5f);
  }
}

// A smooth picture, so that what jumps would be a piece.
TEST(StochasticTiling, HasNoSeams) {
  constexpr float kTurn = glm::two_pi<float>();
  const auto picture = [](glm::vec2 at) { return std::sin(kTurn * at.x) + std::cos(kTurn * at.y); };
  const auto shown = [&](glm::vec2 texcoord) {
    const StochasticPlace place = stochasticPlace(texcoord);
    float value = 0.3f * place.meanShare;
    for (const TilingTap& tap : place.taps) value += tap.share * picture(tap.texcoord);
    return value;
  };
  const glm::vec2 step = glm::normalize(glm::vec2(0.8f, 0.33f)) * 1e-3f;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec2 at = step * static_cast<float>(i) - glm::vec2(3.0f);
    ASSERT_NEAR(shown(at), shown(at + step), 0.05f) << at.x << ", " << at.y;
  }
}

TEST(StochasticTiling, NoiseKeepsItsMeanAndVarianceAndDoesNotRepeat) {
  const std::vector<float> surface = surfaceOf(noise(), 8);
  const float mean = meanOf(surface);
  const std::size_t width = 8 * kSide;
  double variance = 0.0, product = 0.0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double value = surface[i] - mean;
    variance += value * value;
    if (i % width + kSide >= width) continue;
    product += value * (surface[i + kSide] - mean);
    ++pairs;
  }
  variance /= static_cast<double>(surface.size());
  EXPECT_NEAR(mean, 0.5f, 0.005f);
  EXPECT_NEAR(variance, 1.0 / 12.0, 0.1 / 12.0);
  EXPECT_LT(std::abs(product / static_cast<double>(pairs)), 0.05 * variance);
}

}  // namespace
}  // namespace weft::test
