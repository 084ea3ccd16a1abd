// A model that an application brings: no file of Weft knows it.
#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "GlTest.h"
#include "GltfText.h"
#include "MemoryBtf.h"
#include "RampFitter.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/fitter/FieldFit.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/reflectance/LayerLookup.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

constexpr int kPixelsASide = 64;
const glm::vec3 kTowardsLight(0.6f, 0.0f, 0.8f);

// Every texel, layer and place in the table another value.
ReflectanceField rampField(int power) {
  const auto model = valueOf(RampModel::registry().create({"ramp", {{"power", power}}}));
  ReflectanceFieldDescription about;
  about.views = {directionFromDegrees(0, 0), directionFromDegrees(60, 10), directionFromDegrees(60, 130),
                 directionFromDegrees(60, 250)};
  about.lights = about.views;
  FieldLevel level{FloatImage(4, 4, model->sharedChannels()), FloatImage(4, 4, model->layerChannels(), 4)};
  for (FloatImage* image : {&level.shared, &level.layers})
    for (std::size_t i = 0; i < image->values().size(); ++i)
      image->values()[i] = 0.5f + 0.5f * std::sin(1.7f * static_cast<float>(i));
  FloatImage ramp(5, 1, {"value"});
  std::ranges::copy(std::array{0.1f, 0.9f, 0.3f, 0.7f, 0.5f}, ramp.values().begin());
  return valueOf(ReflectanceField::create(model, about, {level}, {{"ramp", ramp}}));
}

// Of a measurement that the model can show: up to half precision nothing is left.
ReflectanceField fittedField() {
  MemoryBtf source(4, 4, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    return glm::vec3((0.4f + 0.1f * std::sin(static_cast<float>(x + 5 * y)) + 0.2f * v.x) * l.z * l.z);
  });
  source.description().views.resize(19);
  FitOptions options;
  options.model = {"ramp", {{"power", 1}}};
  options.models = RampModel::registry();
  options.fitters = RampFitter::registry();
  FitResult fit = valueOf(fitReflectanceField(source, options));
  EXPECT_LT(fit.errors.of(ErrorSpace::Linear, ErrorMeasure::Luminance).average, 5e-4);
  return std::move(fit.field);
}

class OwnModel : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    folder = testFolder();
    writeText(folder / "scene.gltf",
              planeGltf(R"({"name":"own","extensions":{"WEFT_materials_btf":{"uri":"own.rf.exr"}}})"));
  }

  // The glTF's plane, from the front.
  FloatImage drawn(const ModelRegistry& models) {
    GltfOptions options;
    options.models = models;
    options.btf.filter = TexelFilter::Nearest;
    Node scene;
    scene.addChild(valueOf(loadGltf(folder / "scene.gltf", options)).root);
    const glm::mat4 turn(glm::vec4(0.8f, 0, -0.6f, 0), glm::vec4(0, 1, 0, 0), glm::vec4(kTowardsLight, 0),
                         glm::vec4(0, 0, 0, 1));
    scene.addChild(std::make_shared<Transform>(turn))
        ->addChild(std::make_shared<DirectionalLight>(glm::vec3(glm::pi<float>())));
    return picture(scene, kPixelsASide, kPixelsASide);
  }

  std::filesystem::path folder;
};

TEST_F(OwnModel, IsFittedWrittenReadLoadedFromGltfAndDrawnAsItsTwinSays) {
  for (const ReflectanceField& made : {rampField(0), rampField(2), fittedField()}) {
    requireDone(writeReflectanceField(made, folder / "own.rf.exr"));
    const ReflectanceField field =
        valueOf(readReflectanceField(folder / "own.rf.exr", RampModel::registry()));
    const FloatImage picture = drawn(RampModel::registry());
    const HemisphereTriangulation& triangulation = field.formula().triangulation();
    const LayerLookup lookup = LayerLookup::create(triangulation);
    for (int y = kPixelsASide / 4; y < 3 * kPixelsASide / 4; ++y)  // which the plane covers
      for (int x = kPixelsASide / 4; x < 3 * kPixelsASide / 4; ++x) {
        const glm::vec3 position(-1.0f + 2.0f * (static_cast<float>(x) + 0.5f) / kPixelsASide,
                                 1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / kPixelsASide, 0.0f);
        const glm::vec3 view = glm::normalize(glm::vec3(0, 0, 2) - position);
        const glm::vec3 value = field.evaluate((x - kPixelsASide / 4) * 8 / kPixelsASide,
                                               (y - kPixelsASide / 4) * 8 / kPixelsASide,
                                               lookup.locate(triangulation, view), kTowardsLight, view);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(picture.at(x, y, c), value[c], 5e-4f) << x << ", " << y;
      }
  }
}

TEST_F(OwnModel, IsNamedWhereTheRegistryLacksIt) {
  requireDone(writeReflectanceField(rampField(1), folder / "own.rf.exr"));
  const GltfScene scene = valueOf(loadGltf(folder / "scene.gltf"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_THAT(scene.warnings[0],
              testing::AllOf(testing::HasSubstr("own.rf.exr"), testing::HasSubstr("unknown model 'ramp'"),
                             testing::HasSubstr("known are rfp")));
}

}  // namespace
}  // namespace weft::test
