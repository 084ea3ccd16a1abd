#include "weft/reflectance/MapTextures.h"

#include <gtest/gtest.h>

#include "PatchMap.h"
#include "SomeModels.h"
#include "weft/core/Color.h"

namespace weft::test {
namespace {

TEST(MapTextures, CoordinatesTakeTwoBytesATexelForSmallSamples) {
  for (const auto& [side, bytes] : {std::pair(256, 2u), {257, 4u}}) {
    const CoordinateMap map = patchMap({33, 20}, {side, 7}, 5);
    const TextureImage packed = packCoordinates(map);
    EXPECT_EQ(packed.byteCount(), 33u * 20 * bytes);
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 33; ++x) {
        const glm::ivec2 texel(packed.at(x, y, 0, 0), packed.at(x, y, 0, 1));
        EXPECT_EQ(texel, map.at(x, y));
      }
  }
}

// A field whose every number is another, and whose light is nowhere clamped.
ReflectanceField brightField(int width, int height) {
  const ReflectanceField uneven = unevenField({"loom", {{"components", 8}}}, width, height);
  std::vector<FieldLevel> levels = uneven.levels();
  for (float& number : levels[0].shared.values()) number = std::abs(number) + 0.01f;
  for (int level = 1; sideOfLevel(width, level - 1) > 1; ++level)
    levels.push_back(
        {FloatImage(sideOfLevel(width, level), sideOfLevel(height, level), uneven.shared().channels()), {}});
  FieldTables tables = uneven.tables();
  FloatImage& maps = tables.at("light_maps");
  for (int x = 0; x < maps.width(); ++x)
    for (int y = 0; y < maps.height(); ++y)
      for (float& hue : maps.texel(x, y).subspan(8)) hue *= 0.01f;
  const auto model = valueOf(ModelRegistry::builtin().create(uneven.model().description()));
  return valueOf(ReflectanceField::create(model, uneven.description(), levels, tables));
}

// The light of a level's texel is the average of what it covers: also where sides are odd, and
// where colours differ.
TEST(MapTextures, LevelsKeepTheLight) {
  const ReflectanceField field = brightField(12, 9);
  const CoordinateMap map = patchMap({75, 50}, {12, 9}, 7);
  const std::vector<FieldLevel> levels = mappedLevels(field, map);
  ASSERT_EQ(levels.size(), 4u);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    EXPECT_EQ(levels[i].shared.width(), field.levels()[i].shared.width());
    EXPECT_EQ(levels[i].shared.height(), field.levels()[i].shared.height());
  }

  std::vector<double> mean(static_cast<std::size_t>(field.shared().channelCount()));
  glm::dvec3 light(0.0), ofLevel(0.0);
  const FieldFormula& formula = field.formula();
  const auto shownBy = [&](std::span<const float> numbers) {
    glm::dvec3 sum(0.0);
    for (int view = 0; view < formula.layerCount(); ++view)
      for (const glm::vec3 from : field.description().lights)
        sum += formula.evaluate(numbers, formula.layerOf({}, view), from,
                                field.description().views[static_cast<std::size_t>(view)]);
    return sum;
  };
  for (const glm::ivec2 texel : map.texels()) {
    const std::span<const float> numbers = field.shared().texel(texel.x, texel.y);
    for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += numbers[c] / (75.0 * 50.0);
    light += shownBy(numbers) / (75.0 * 50.0);
  }
  const std::span<const float> top = levels[3].shared.texel(0, 0);
  for (std::size_t c = 3; c < mean.size(); ++c) EXPECT_NEAR(top[c], mean[c], 1e-5);
  ofLevel = shownBy(top);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(ofLevel[c], light[c], 0.01 * light[c]) << c;
}

}  // namespace
}  // namespace weft::test
