// Coarser levels of models whose parameters cannot be filtered.
#include <glm/geometric.hpp>

#include "SomeModels.h"
#include "TestSupport.h"
#include "TurnedSquare.h"
#include "weft/materials/BTFMap.h"

namespace weft::test {
namespace {

/// Down to one texel, every number another.
ReflectanceField fieldOfLevels(const ModelDescription& description, glm::ivec2 size) {
  const ReflectanceField finest = unevenField(description, size.x, size.y);
  std::vector<FieldLevel> levels{finest.levels().front()};
  while (size != glm::ivec2(1)) {
    size = glm::max(size / 2, 1);
    const ReflectanceField coarser = unevenField(description, size.x, size.y);
    levels.push_back(coarser.levels().front());
    for (float& number : levels.back().shared.values()) number *= 0.1f * static_cast<float>(levels.size());
    levels.back().shared.roundToHalf();
  }
  const auto model = valueOf(ModelRegistry::builtin().create(description));
  return valueOf(ReflectanceField::create(model, finest.description(), std::move(levels)));
}

/// Each level as a field of its own.
std::vector<ReflectanceField> fieldsOfLevels(const ReflectanceField& field) {
  const auto model = valueOf(ModelRegistry::builtin().create(field.model().description()));
  std::vector<ReflectanceField> fields;
  for (const FieldLevel& level : field.levels())
    fields.push_back(
        valueOf(ReflectanceField::create(model, field.description(), level.shared, level.layers)));
  return fields;
}

struct Directions {
  DirectionWeights layers;
  glm::vec3 light;
  glm::vec3 view;
};

/// What the four texels around a place show, mixed; the field once is 1.
glm::vec3 mixedAround(const ReflectanceField& field, glm::vec2 texcoord, const Directions& directions) {
  const glm::vec2 place = texcoord * glm::vec2(field.width(), field.height()) - 0.5f;
  const glm::vec2 low = glm::floor(place), upper = place - low;
  const auto wrapped = [](int texel, int side) { return (texel % side + side) % side; };
  glm::vec3 value(0.0f);
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx)
      value += (dx == 1 ? upper.x : 1.0f - upper.x) * (dy == 1 ? upper.y : 1.0f - upper.y) *
               field.evaluate(wrapped(static_cast<int>(low.x) + dx, field.width()),
                              wrapped(static_cast<int>(low.y) + dy, field.height()), directions.layers,
                              directions.light, directions.view);
  return value;
}

class TexelLevelsTest : public TurnedSquareTest {
 protected:
  const Frame frame_ = frameSeenFrom(glm::normalize(glm::vec3(0.2f, -0.3f, 0.8f)));
  const glm::vec3 towardsLight_ = frame_.axes * glm::normalize(glm::vec3(0.4f, 0.3f, 0.5f));

  static BTFMaterialOptions repeated(float repetitions) { return {.textureScale = glm::vec2(repetitions)}; }
};

// A pixel that covers n x n texels shows the two levels around log2(n) - 0.5.
TEST_F(TexelLevelsTest, ResultsOfTwoLevelsAreMixed) {
  for (const auto& [description, size] : {std::pair(ModelDescription{"rfnl"}, glm::ivec2(13, 10)),
                                          {ModelDescription{"rfp", {{"color", "rgb"}}}, glm::ivec2(8, 8)},
                                          {ModelDescription{"slaf"}, glm::ivec2(4, 9)},
                                          {ModelDescription{"lfnl"}, glm::ivec2(8, 4)}}) {
    const auto field = std::make_shared<const ReflectanceField>(fieldOfLevels(description, size));
    const std::vector<ReflectanceField> levels = fieldsOfLevels(*field);
    const auto layers = layersOnTheGpu(*field);
    const glm::vec3 light = frame_.toFrame(towardsLight_);
    for (const float pixel : {0.1f, 1.0f, 1.4f, 2.0f, 3.3f, 40.0f}) {  // in texels
      const float side = std::sqrt(static_cast<float>(size.x * size.y));
      const float repetitions = pixel * static_cast<float>(kPictureSize) / side;
      const float detail =
          std::clamp(std::log2(pixel) - 0.5f, 0.0f, static_cast<float>(field->levels().size()) - 1.0f);
      const auto finer = static_cast<std::size_t>(detail);
      const std::size_t coarser = std::min(finer + 1, levels.size() - 1);
      const FloatImage expected = pictureOf(frame_, [&](int x, int y, glm::vec3 view) {
        const glm::vec2 texcoord =
            glm::fract((glm::vec2(x, y) + 0.5f) * repetitions / static_cast<float>(kPictureSize));
        const Directions directions{layers(light, view), light, view};
        return glm::mix(mixedAround(levels[finer], texcoord, directions),
                        mixedAround(levels[coarser], texcoord, directions),
                        detail - static_cast<float>(finer));
      });
      SCOPED_TRACE(nameOf(description) + " " + std::to_string(pixel));
      const float brightest = *std::ranges::max_element(expected.values());
      expectEqualPictures(render(repeated(repetitions), field, frame_, towardsLight_), expected,
                          3e-3f * std::max(brightest, 1.0f), 1e-3);
    }
  }
}

TEST_F(TexelLevelsTest, AMapThatRepeatsTheSampleChangesNothing) {
  const auto field = std::make_shared<const ReflectanceField>(fieldOfLevels({"rfnl"}, {8, 8}));
  std::vector<glm::u16vec2> texels;
  for (int i = 0; i < 64 * 64; ++i) texels.emplace_back(i % 8, i / 64 % 8);
  const CoordinateMap map = valueOf(CoordinateMap::create(64, 64, 8, 8, std::move(texels)));
  const auto textures = valueOf(BTFTextures::create(*field));
  const auto made = valueOf(BTFMap::create(map, *textures, [&] { return Result<ReflectanceField>(*field); }));
  for (const float pixel : {0.3f, 1.6f, 4.0f, 13.0f}) {
    const float repetitions = pixel * static_cast<float>(kPictureSize) / 8.0f;
    const auto mapped = valueOf(BTFMaterial::create(textures, repeated(repetitions / 8.0f)));
    requireDone(mapped->setMap(made));
    SCOPED_TRACE(pixel);
    expectEqualPictures(render(mapped, frame_, towardsLight_),
                        render(repeated(repetitions), field, frame_, towardsLight_), 1e-2f);
  }
}

}  // namespace
}  // namespace weft::test
