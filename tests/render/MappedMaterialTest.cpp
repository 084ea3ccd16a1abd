// What coordinate maps show, beside what the CPU says of it.
#include <array>

#include "FilteredField.h"
#include "PatchMap.h"
#include "TurnedSquare.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/reflectance/MapTextures.h"

namespace weft::test {
namespace {

// Four results, mixed: at a place in texels, where the centre of the first is at 0, 0.
glm::vec3 mixedResults(const ReflectanceField& field, const CoordinateMap& map, glm::vec2 place,
                       const DirectionWeights& layers, glm::vec3 light, glm::vec3 view) {
  const glm::ivec2 size(map.width(), map.height()), low = glm::floor(place);
  const glm::vec2 upper = place - glm::vec2(low);
  glm::vec3 value(0.0f);
  for (int i = 0; i < 4; ++i) {
    const glm::ivec2 corner(i % 2, i / 2), texel = (low + corner + size) % size;
    const glm::vec2 weight = glm::mix(1.0f - upper, upper, glm::vec2(corner));
    value += weight.x * weight.y * field.evaluate(map, texel.x, texel.y, layers, light, view);
  }
  return value;
}

class MappedMaterialTest : public TurnedSquareTest {
 protected:
  static std::shared_ptr<BTFMaterial> material(const ReflectanceField& field, const CoordinateMap& map,
                                               const BTFMaterialOptions& options = {}) {
    const auto textures = valueOf(BTFTextures::create(field));
    const auto made = valueOf(BTFMaterial::create(textures, options));
    requireDone(made->setMap(
        valueOf(BTFMap::create(map, *textures, [&] { return Result<ReflectanceField>(field); }))));
    return made;
  }

  const Frame frame_ = frameSeenFrom(glm::normalize(glm::vec3(0.2f, -0.3f, 0.8f)));
  const glm::vec3 towardsLight_ = frame_.axes * glm::normalize(glm::vec3(0.4f, 0.3f, 0.5f));
  const glm::vec3 light_ = frame_.toFrame(towardsLight_);
};

// What is seen through the map's texel under each pixel, over random views and lights: of
// registered models that lies between texels, and the map may jump there.
TEST_F(MappedMaterialTest, TexelsAreThoseOfTheMap) {
  for (const auto& [model, sample] : {std::pair("rfnl", glm::ivec2(8, 8)),
                                      {"lfp", glm::ivec2(300, 2)},
                                      {"loom", glm::ivec2(8, 6)},
                                      {"loom", glm::ivec2(300, 2)},
                                      {"lod", glm::ivec2(8, 6)}}) {
    const ReflectanceField field = unevenField({.name = model}, sample.x, sample.y);
    const CoordinateMap map = patchMap({16, 32}, sample, 3);
    const auto shown = material(field, map, {.filter = TexelFilter::Nearest});
    const auto layers = layersOnTheGpu(field);
    std::mt19937 random(2003);
    for (int pair = 0; pair < 4; ++pair) {
      const Frame frame = frameSeenFrom(randomDirection(random, 0.02f));
      const glm::vec3 towardsLight = frame.axes * randomDirection(random, 0.0f);
      const glm::vec3 light = frame.toFrame(towardsLight);
      const FloatImage expected = pictureOf(frame, [&](int x, int y, glm::vec3 view) {
        return field.evaluate(map, x * map.width() / kPictureSize, y * map.height() / kPictureSize,
                              layers(light, view), light, view);
      });
      SCOPED_TRACE(model);
      expectEqualPictures(render(shown, frame, towardsLight), expected, 5e-4f, 1e-4);
    }
  }
}

// The surface's four texels around a place, wherever in the sample they lie.
TEST_F(MappedMaterialTest, FiltersAcrossJumps) {
  const CoordinateMap map = patchMap({16, 16}, {8, 8}, 3);
  const ReflectanceField filtered = filteredField(8), lobes = unevenField({.name = "rfnl"}, 8, 8);
  for (const ReflectanceField* field : {&filtered, &lobes}) {
    const auto layers = layersOnTheGpu(*field);
    std::vector<float> numbers;
    const FloatImage expected = pictureOf(frame_, [&](int x, int y, glm::vec3 view) {
      const glm::vec2 place = (glm::vec2(x, y) + 0.5f) * 16.0f / static_cast<float>(kPictureSize) - 0.5f;
      const DirectionWeights weights = layers(light_, view);
      if (field == &lobes) return mixedResults(lobes, map, place, weights, light_, view);
      return valueOfNumbers(filtered, filteredTexel(filtered.shared(), map, place, numbers), weights, light_,
                            view);
    });
    const auto shown = material(*field, map);
    expectEqualPictures(render(shown, frame_, towardsLight_), expected, 5e-3f);
  }
}

// The surface has as many texels as the sample 4 levels above its finest: there, and beyond, a
// pixel that covers one shows it.
TEST_F(MappedMaterialTest, CoarseLevelsAreTheSurfaces) {
  const ReflectanceField field = filteredField(8);
  const CoordinateMap map = patchMap({kPictureSize, kPictureSize}, {8, 8}, 5);
  const std::vector<FieldLevel> made = mappedLevels(field, map);
  const TextureImage levels = packFilteredNumbers({made});
  const auto layers = layersOnTheGpu(field);
  std::vector<float> numbers(field.shared().texel(0, 0).begin(), field.shared().texel(0, 0).end());
  for (const int level : {0, 1}) {
    const int side = 8 >> level;
    const FloatImage expected = pictureOf(frame_, [&](int x, int y, glm::vec3 view) {
      for (int i = 0; i < 8; ++i)
        numbers[static_cast<std::size_t>(3 + i)] = levels.at(x % side, y % side, i / 4, i % 4, level);
      return valueOfNumbers(field, numbers, layers(light_, view), light_, view);
    });
    const auto shown = material(
        field, map, {.textureScale = glm::vec2(static_cast<float>(kPictureSize) / static_cast<float>(side))});
    SCOPED_TRACE(level);
    expectEqualPictures(render(shown, frame_, towardsLight_), expected, 5e-3f);
  }
}

// A map that only repeats the sample changes nothing, near, far and in between.
TEST_F(MappedMaterialTest, ARepeatedSampleLooksAsWithoutAMap) {
  const ReflectanceField field = filteredField(8);
  std::vector<glm::u16vec2> texels;
  for (int i = 0; i < 64 * 64; ++i) texels.emplace_back(i % 8, i / 64 % 8);
  const CoordinateMap map = valueOf(CoordinateMap::create(64, 64, 8, 8, std::move(texels)));
  const auto shared = std::make_shared<const ReflectanceField>(field);
  for (const float pixel : {0.3f, 1.6f, 5.0f, 10.0f, 13.0f, 40.0f}) {  // in texels
    const float repetitions = pixel * static_cast<float>(kPictureSize) / 8.0f;
    const auto mapped = material(field, map, {.textureScale = glm::vec2(repetitions / 8.0f)});
    const FloatImage plain = render({.textureScale = glm::vec2(repetitions)}, shared, frame_, towardsLight_);
    SCOPED_TRACE(pixel);
    expectEqualPictures(render(mapped, frame_, towardsLight_), plain, 1e-2f);
  }
}

TEST_F(MappedMaterialTest, MapsComeAndGoAndMustFit) {
  const ReflectanceField field = unevenField({.name = "rfnl"}, 8, 8);
  const auto textures = valueOf(BTFTextures::create(field));
  const auto mapFor = [&](glm::ivec2 sample) {
    return BTFMap::create(patchMap({16, 16}, sample, 3), *textures,
                          [&] { return Result<ReflectanceField>(field); });
  };
  const auto wrong = mapFor({8, 4});
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message().find("8 x 4 texels, the reflectance field has 8 x 8"), std::string::npos);

  const auto shown = valueOf(BTFMaterial::create(textures));
  const FloatImage plain = render(shown, frame_, towardsLight_);
  requireDone(shown->setMap(valueOf(mapFor({8, 8}))));
  EXPECT_EQ(shown->surfaceSize(), glm::ivec2(16));
  EXPECT_GT(compareImages(render(shown, frame_, towardsLight_), plain, 1e-3f).failingShare, 0.5);
  requireDone(shown->setMap(nullptr));
  expectEqualPictures(render(shown, frame_, towardsLight_), plain, 0.0f);
  const auto other = valueOf(
      BTFMaterial::create(std::make_shared<const ReflectanceField>(unevenField({.name = "rfnl"}, 4, 8))));
  EXPECT_FALSE(other->setMap(valueOf(mapFor({8, 8}))));
}

}  // namespace
}  // namespace weft::test
