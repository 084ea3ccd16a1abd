#include "weft/reflectance/FieldTextures.h"
#include "weft/shaders/Bindings.h"

#include <gtest/gtest.h>

#include "RampModel.h"
#include "SomeModels.h"

namespace weft {
namespace {

constexpr int kWidth = 3;
constexpr int kHeight = 2;

ReflectanceField unevenField(const ModelDescription& description, Precision precision = Precision::Half) {
  return test::unevenField(description, kWidth, kHeight, precision);
}

// As a shader reads them: `number` of a run of texels that starts at layer `first`.
float numberAt(const TextureImage& image, int x, int y, int first, int number) {
  return image.at(x, y, first + number / 4, number % 4);
}

TEST(FieldTextures, HoldEveryNumberWhereShadersReadIt) {
  for (const ModelDescription& description : test::someModels()) {
    const ReflectanceField field = unevenField(description);
    const ReflectanceModel& model = field.model();
    const FieldTextures textures = FieldTextures::create(field);
    const int channels = model.colorChannels();
    const int sharedTexels = FieldTextures::sharedTexels(model);
    const int layerTexels = FieldTextures::layerTexels(model);
    const int sharedParameters = static_cast<int>(model.sharedParameters().size());
    const int layerParameters = static_cast<int>(model.layerParameters().size());
    EXPECT_EQ(textures.shared.layers(), channels * sharedTexels) << description.name;
    EXPECT_EQ(textures.layers.layers(), FieldTextures::arrayLayers(field.formula())) << description.name;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (int c = 0; c < channels; ++c) {
          const bool apart = model.filtersParameters() || model.summedLevels() > 0;
          for (int i = 0; i < 3 && model.summedLevels() == 0; ++i)
            EXPECT_EQ(numberAt(apart ? textures.baseColors : textures.shared, x, y, c * sharedTexels, i),
                      field.shared().at(x, y, i));
          for (int i = 0; i < sharedParameters; ++i)
            EXPECT_EQ(numberAt(textures.shared, x, y, c * sharedTexels, (apart ? 0 : 3) + i),
                      field.shared().at(x, y, 3 + c * sharedParameters + i));
          for (int layer = 0; layer < field.layers().layers(); ++layer)
            for (int i = 0; i < layerParameters; ++i)
              EXPECT_EQ(numberAt(textures.layers, x, y, (layer * channels + c) * layerTexels, i),
                        field.layers().at(x, y, c * layerParameters + i, layer));
        }
  }
}

TEST(FieldTextures, AreAsLargeAsGpuBytesSays) {
  for (const ModelDescription& description : test::someModels())
    for (Precision precision : {Precision::Half, Precision::Float}) {
      const ReflectanceField field = unevenField(description, precision);
      const FieldTextures textures = FieldTextures::create(field);
      std::uint64_t bytes = textures.shared.byteCount() + textures.layers.byteCount();
      bytes += textures.baseColors.byteCount();
      for (const auto& [name, table] : textures.tables) bytes += table.byteCount();
      EXPECT_EQ(gpuBytes(field), bytes) << description.name;
    }
  // 2 lobes: 4 shared numbers, 8 a view; 3 lobes and its own albedo: 3 shared, 13 a view.
  EXPECT_EQ(gpuBytes(unevenField({})), 8u * kWidth * kHeight * (1 + 2 * 4));
  EXPECT_EQ(gpuBytes(unevenField({"rfnl", {{"lobes", 3}, {"rho_d", "per-view"}}})),
            8u * kWidth * kHeight * (1 + 4 * 4));
}

TEST(FieldTextures, PreparedLayersAreWhatTheModelMakesOfThem) {
  const ReflectanceField field = unevenField({"rfnl", {{"color", "rgb"}}});
  const FieldTextures textures = FieldTextures::create(field, true);
  std::vector<float> numbers(field.layers().texel(2, 1, 3).begin() + 8,
                             field.layers().texel(2, 1, 3).begin() + 16);
  ASSERT_TRUE(field.model().prepareForEnvironments(numbers));
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(numberAt(textures.preparedLayers, 2, 1, (3 * 3 + 1) * 2, i),
              roundToHalf(numbers[static_cast<std::size_t>(i)]));
}

TEST(FieldTextures, HoldLevelsAndTables) {
  const auto model = test::valueOf(test::RampModel::registry().create({"ramp"}));
  ReflectanceFieldDescription about;
  about.views = about.lights = {{0, 0, 1}};
  std::vector<FieldLevel> levels;
  for (const auto& [width, height] : {std::pair(3, 2), {1, 1}})
    levels.push_back({test::unevenNumbers(width, height, model->sharedChannels(), 1, Precision::Half),
                      test::unevenNumbers(width, height, model->layerChannels(), 1, Precision::Half)});
  levels[1].layers.at(0, 0, 0) = 0.25f;
  const FloatImage ramp = test::unevenNumbers(5, 1, {"value"}, 1, Precision::Float);
  const ReflectanceField field =
      test::valueOf(ReflectanceField::create(model, about, levels, {{"ramp", ramp}}));
  const FieldTextures textures = FieldTextures::create(field);
  ASSERT_EQ(textures.layers.levels(), 2);
  EXPECT_EQ(textures.layers.at(0, 0, 0, 0, 1), 0.25f);
  EXPECT_EQ(textures.shared.at(0, 0, 0, 2, 1), levels[1].shared.at(0, 0, 2));
  for (int x = 0; x < 5; ++x) EXPECT_EQ(textures.tables.at("ramp").at(x, 0, 0, 0), ramp.at(x, 0, 0));
  EXPECT_EQ(gpuBytes(field), 8u * 2 * (3 * 2 + 1) + 16u * 5);
  const FieldProgram program = FieldProgram::create(field);
  EXPECT_EQ(program.defines.at("TABLE_ramp"), std::to_string(bindings::firstTableUnit));
  EXPECT_EQ(program.texts.at("ramp.glsl"), model->shaderText());
}

TEST(FieldTextures, AreOnlyPreparedWhereThatIsOfUse) {
  EXPECT_TRUE(FieldTextures::create(unevenField({})).preparedLayers.empty());
  for (const char* name : {"rfp", "laf", "lfnl", "bump"})
    EXPECT_TRUE(FieldTextures::create(unevenField({.name = name}), true).preparedLayers.empty()) << name;
}

TEST(FieldProgram, HasALookupForLayersAloneAndNodesWhereNoFormulaIntegrates) {
  const FieldProgram views = FieldProgram::create(unevenField({}));
  EXPECT_FALSE(views.lookup.triangles.empty());
  EXPECT_TRUE(views.quadrature.empty());
  const ReflectanceField lightField = unevenField({.name = "lfnl"});
  const FieldProgram lights = FieldProgram::create(lightField);
  EXPECT_EQ(lights.quadrature.width(), static_cast<int>(lightField.formula().quadrature().nodes.size()));
  EXPECT_TRUE(FieldProgram::create(unevenField({.name = "laf"})).lookup.triangles.empty());
}

}  // namespace
}  // namespace weft
