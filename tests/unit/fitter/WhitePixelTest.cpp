#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

// [Meseth 2004] 5.3: a lobe that no measured light holds may shine as a white pixel in between.

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

// A dull surface with shadows and a highlight of which the measured lights see the foot: texel x
// turns it around between the lights, texel y lowers it to the horizon and below.
glm::vec3 footOfAHighlight(int x, int y, glm::vec3 v, glm::vec3 l) {
  const float azimuth = 0.13f * static_cast<float>(x) + std::atan2(v.y, v.x);
  const float elevation = 0.15f * static_cast<float>(3 - y);
  const glm::vec3 sharp(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                        std::sin(elevation));
  const bool inShadow = l.x * v.y + 0.2f > 0.5f * l.z + 0.4f;
  const float foot = 2.0f * std::pow(std::max(glm::dot(sharp, l), 0.0f), 60.0f);
  return glm::vec3(l.z * (inShadow ? 0.005f : 0.05f + std::min(foot, 0.4f)));
}

struct Model {
  const char* name;
  int lobes;
  FitSpace space = FitSpace::Linear;
};

class WhitePixel : public testing::TestWithParam<Model> {};

TEST_P(WhitePixel, NoLightMakesOne) {
  constexpr int kSide = 8;
  const MemoryBtf source(kSide, kSide, footOfAHighlight);
  const BtfDescription& measured = source.description();
  FitOptions options;
  options.model.name = GetParam().name;
  if (GetParam().lobes > 0) options.model.options["lobes"] = GetParam().lobes;
  options.space = GetParam().space;
  const FitResult fit = valueOf(fitReflectanceField(source, options));

  std::vector<float> brightest;  // [row][column][view]
  for (int texel = 0; texel < kSide * kSide; ++texel)
    for (glm::vec3 view : measured.views) {
      brightest.push_back(0.0f);
      for (glm::vec3 light : measured.lights)
        brightest.back() =
            std::max(brightest.back(), footOfAHighlight(texel % kSide, texel / kSide, view, light).y);
    }

  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  float worst = 0.0f;
  for (int i = 0; i < 200'000; ++i) {
    const int x = static_cast<int>(random() % kSide);
    const int y = static_cast<int>(random() % kSide);
    const std::size_t view = random() % measured.views.size();
    const float z = unit(random);
    const float azimuth = 2.0f * std::numbers::pi_v<float> * unit(random);
    const float across = std::sqrt(1.0f - z * z);
    const glm::vec3 light(across * std::cos(azimuth), across * std::sin(azimuth), z);
    const float value = luminance(fit.field.evaluate(x, y, light, measured.views[view]));
    ASSERT_TRUE(std::isfinite(value));
    worst = std::max(
        worst, value / brightest[static_cast<std::size_t>(y * kSide + x) * measured.views.size() + view]);
  }
  EXPECT_LT(worst, 1.5f);
  EXPECT_GT(worst, 0.5f) << "the highlight should be there at all";
}

INSTANTIATE_TEST_SUITE_P(Models, WhitePixel,
                         testing::Values(Model{"rfnl", 1}, Model{"rfnl", 2}, Model{"rfnl", 4},
                                         Model{"rfnl", 2, FitSpace::Stored}, Model{"rfp", 0}, Model{"laf", 3},
                                         Model{"slaf", 3}),
                         [](const auto& model) {
                           return std::string(model.param.name) + std::to_string(model.param.lobes) +
                                  (model.param.space == FitSpace::Stored ? "stored" : "");
                         });

}  // namespace
}  // namespace weft
