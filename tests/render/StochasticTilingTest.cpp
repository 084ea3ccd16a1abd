// A sample tiled at random, beside what the CPU says of it.
#include <functional>

#include "FilteredField.h"
#include "PatchMap.h"
#include "TurnedSquare.h"
#include "weft/reflectance/StochasticTiling.h"

namespace weft::test {
namespace {

class StochasticTilingTest : public TurnedSquareTest {
 protected:
  static constexpr float kSide = 8.0f;

  glm::vec3 meanSeen(glm::vec3 view) const {
    return valueOfNumbers(*field_, field_->levels().back().shared.texel(0, 0), layers_(light_, view), light_,
                          view);
  }

  glm::vec3 seenAt(glm::vec2 texcoord, glm::vec3 view) const {
    const StochasticPlace place = stochasticPlace(texcoord);
    glm::vec3 value = place.meanShare * meanSeen(view);
    std::vector<float> numbers;
    for (const TilingTap& tap : place.taps)
      value += tap.share *
               valueOfNumbers(*field_, filteredTexel(field_->shared(), tap.texcoord * kSide - 0.5f, numbers),
                              layers_(light_, view), light_, view);
    return glm::max(value, 0.0f);
  }

  FloatImage shownWith(float scale) {
    return render(
        {.textureScale = glm::vec2(scale), .filter = TexelFilter::Bilinear, .tiling = Tiling::Stochastic},
        field_, frame_, towardsLight_);
  }

  const std::shared_ptr<const ReflectanceField> field_ =
      std::make_shared<const ReflectanceField>(filteredField(static_cast<int>(kSide)));
  const std::function<DirectionWeights(glm::vec3, glm::vec3)> layers_ = layersOnTheGpu(*field_);
  const Frame frame_ = frameSeenFrom(glm::normalize(glm::vec3(0.2f, -0.3f, 0.8f)));
  const glm::vec3 towardsLight_ = frame_.axes * glm::normalize(glm::vec3(0.4f, 0.3f, 0.5f));
  const glm::vec3 light_ = frame_.toFrame(towardsLight_);
};

TEST_F(StochasticTilingTest, ShowsThePlacesOfTheSampleThatTheCpuNames) {
  const float scale = 3.0f;
  const FloatImage expected = pictureOf(frame_, [&](int x, int y, glm::vec3 view) {
    return seenAt((glm::vec2(x, y) + 0.5f) * scale / static_cast<float>(kPictureSize), view);
  });
  expectEqualPictures(shownWith(scale), expected, 1e-2f);
}

TEST_F(StochasticTilingTest, IsTheMeanFarAway) {
  const FloatImage expected = pictureOf(frame_, [&](int, int, glm::vec3 view) { return meanSeen(view); });
  expectEqualPictures(shownWith(5000.0f), expected, 1e-2f);
}

TEST_F(StochasticTilingTest, IsRefusedWhereItCannotBe) {
  const BTFMaterialOptions options{.tiling = Tiling::Stochastic};
  const auto lobes = std::make_shared<const ReflectanceField>(unevenField({.name = "rfnl"}, 8, 8));
  const auto refused = BTFMaterial::create(lobes, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message().find("weft-synth"), std::string::npos);
  const auto made = valueOf(BTFMaterial::create(field_, options));
  const auto map = BTFMap::create(patchMap({16, 16}, {8, 8}, 3), *made->textures(),
                                  [&] { return Result<ReflectanceField>(*field_); });
  EXPECT_FALSE(made->setMap(valueOf(map)));
  requireDone(made->setOptions({}));
  requireDone(made->setMap(valueOf(map)));
  EXPECT_FALSE(made->setOptions(options));
}

}  // namespace
}  // namespace weft::test
