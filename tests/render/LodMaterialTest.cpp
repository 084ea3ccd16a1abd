#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "SomeModels.h"
#include "TestSupport.h"
#include "TurnedSquare.h"
#include "weft/reflectance/LevelSum.h"
#include "weft/reflectance/LodModel.h"

namespace weft::test {
namespace {

/// Levels of which every number is another, the last of one texel a side or of some.
std::shared_ptr<const ReflectanceField> pyramidField(int width, int height, int levels, int chroma) {
  const ReflectanceField finest = unevenField({"lod", {{"chroma", chroma}}}, width, height);
  FieldTables tables = finest.tables();
  FloatImage& maps = tables.at("eigen_brdfs");
  maps = unevenNumbers(maps.width(), levels * maps.height(), maps.channels(), 1, Precision::Half);
  for (float& number : maps.values()) number = 0.1f * (number - 1.1f);
  maps.roundToHalf();
  FloatImage& polynomials = tables.at("light_polynomials");
  polynomials = unevenNumbers(polynomials.width(), levels * polynomials.height(), polynomials.channels(), 1,
                              Precision::Half);
  tables.at("mean").at(0, 0, LodModel::Levels) = static_cast<float>(levels);
  std::vector<FieldLevel> made;
  for (int level = 0; level < levels; ++level) {
    FloatImage shared = unevenNumbers(sideOfLevel(width, level), sideOfLevel(height, level),
                                      finest.shared().channels(), 1, Precision::Half);
    roundAsFiltered(shared);
    made.push_back({std::move(shared), {}});
  }
  const auto model = valueOf(ModelRegistry::builtin().create(finest.model().description()));
  return std::make_shared<const ReflectanceField>(
      valueOf(ReflectanceField::create(model, finest.description(), made, tables)));
}

class LodMaterialTest : public TurnedSquareTest {
 protected:
  // The surface is repeated so often, a pixel thus covers some texels.
  void expectLevelOfDetail(const std::shared_ptr<const ReflectanceField>& field, float repetitions) {
    const auto layers = layersOnTheGpu(*field);
    const Frame frame = frameSeenFrom(glm::normalize(glm::vec3(0.2f, -0.3f, 0.8f)));
    const glm::vec3 towardsLight = frame.axes * glm::normalize(glm::vec3(0.4f, 0.3f, 0.5f));
    const glm::vec3 light = frame.toFrame(towardsLight);
    const glm::vec2 size(field->width(), field->height());
    const float step = repetitions * std::sqrt(size.x * size.y) / static_cast<float>(kPictureSize);
    const float detail = detailAtDistance(step, static_cast<int>(field->levels().size()));
    std::vector<float> numbers;
    const FloatImage expected = pictureOf(frame, [&](int x, int y, glm::vec3 view) {
      const glm::vec2 texcoord = (glm::vec2(x, y) + 0.5f) * repetitions / static_cast<float>(kPictureSize);
      numbersOfLevels(field->levels(), (texcoord - glm::floor(texcoord)) * size - 0.5f, detail, numbers);
      const DirectionWeights weights = layers(light, view);
      glm::vec3 value(0.0f);
      for (int k = 0; k < 3; ++k)
        value += weights.weight[k] *
                 field->formula().evaluate(
                     numbers, field->formula().layerOf({}, weights.index[static_cast<std::size_t>(k)]), light,
                     view);
      return value;
    });
    SCOPED_TRACE(repetitions);
    expectEqualPictures(render({.textureScale = glm::vec2(repetitions)}, field, frame, towardsLight),
                        expected, 2e-3f);
  }
};

TEST_F(LodMaterialTest, ShowsTheLevelsThatItsSizeAsksFor) {
  const auto field = pyramidField(8, 8, 4, 2);
  for (const float repetitions : {1.0f, 16.0f, 24.0f, 32.0f, 50.0f, 64.0f, 256.0f})
    expectLevelOfDetail(field, repetitions);
}

TEST_F(LodMaterialTest, OddSidesAndMoreChromaLikewise) {
  const auto field = pyramidField(13, 10, 3, 6);
  for (const float repetitions : {1.0f, 16.0f, 40.0f}) expectLevelOfDetail(field, repetitions);
}

}  // namespace
}  // namespace weft::test
