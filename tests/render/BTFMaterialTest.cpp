#include "weft/materials/BTFMaterial.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "MemoryBtf.h"
#include "SomeModels.h"
#include "SomeViews.h"
#include "TestSupport.h"
#include "TurnedSquare.h"
#include "weft/core/ImageComparison.h"
#include "weft/fitter/FieldFit.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

// What the CPU says of the same picture. `weights` finds the layers of a light and a view.
template <class Weights>
FloatImage referencePicture(const ReflectanceField& field, const Frame& frame, glm::vec3 towardsLight,
                            const Weights& weights) {
  const glm::vec3 light = frame.toFrame(towardsLight);
  return pictureOf(frame, [&](int x, int y, glm::vec3 view) {
    return field.evaluate(x * field.width() / kPictureSize, y * field.height() / kPictureSize,
                          weights(light, view), light, view);
  });
}

using BTFMaterialTest = TurnedSquareTest;

class GpuAgainstCpu : public BTFMaterialTest, public testing::WithParamInterface<ModelDescription> {
 protected:
  // Over random pairs of light and view, some of them below the measured rings.
  void expectAgreement(const std::shared_ptr<const ReflectanceField>& field, double failingShare = 0.0,
                       int pairs = 20, float tolerance = 5e-4f) {
    const auto layers = layersOnTheGpu(*field);
    std::mt19937 random(2004);
    for (int pair = 0; pair < pairs; ++pair) {
      const Frame frame = frameSeenFrom(randomDirection(random, 0.02f));
      const glm::vec3 towardsLight = frame.axes * randomDirection(random, 0.0f);
      const FloatImage expected = referencePicture(*field, frame, towardsLight, layers);
      const float brightest = *std::ranges::max_element(expected.values());
      expectEqualPictures(render({.filter = TexelFilter::Nearest}, field, frame, towardsLight), expected,
                          tolerance * std::max(brightest, 1.0f), failingShare);
    }
  }
};

TEST_P(GpuAgainstCpu, AgreeOnMadeUpNumbers) {
  // Exponents below 1, which fits never have, are so steep where a lobe ends that a pixel may
  // differ there.
  expectAgreement(std::make_shared<const ReflectanceField>(unevenField(GetParam(), 8, 8)), 1e-4);
}

TEST_P(GpuAgainstCpu, AgreeOnStoredValues) {
  const ReflectanceField linear = unevenField(GetParam(), 8, 8);
  ReflectanceFieldDescription stored = linear.description();
  stored.encoding = Encoding::Gamma22;
  const auto model = valueOf(ModelRegistry::builtin().create(GetParam()));
  expectAgreement(std::make_shared<const ReflectanceField>(
                      valueOf(ReflectanceField::create(model, stored, linear.levels(), linear.tables()))),
                  1e-4, 4);
}

TEST_P(GpuAgainstCpu, AgreeOnTheFittedWool) {
  WEFT_DATA_FILE(file, "ubo2003/UBO_WOOL64.zip");
  std::shared_ptr<const BtfSource> source = valueOf(openBtf(file));
  if (GetParam().name == "ptm") source = std::make_shared<SomeViews>(source, std::vector<int>{0});
  FitOptions options;
  options.model = GetParam();
  options.crop = Crop{20, 20, 8, 8};
  auto fit = valueOf(fitReflectanceField(*source, options));
  expectAgreement(std::make_shared<const ReflectanceField>(std::move(fit.field)));
}

INSTANTIATE_TEST_SUITE_P(Models, GpuAgainstCpu, testing::ValuesIn(someModels()),
                         [](const auto& test) { return nameOf(test.param); });

// A field whose every number is different, so that a mix-up of texels, views or channels shows.
std::shared_ptr<const ReflectanceField> glossyReliefField(bool cosineInModel = false,
                                                          const char* model = "rfp") {
  const MemoryBtf source(8, 8, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    const float relief = 1.0f + 0.4f * std::sin(0.8f * static_cast<float>(x) + 2.0f * l.x) *
                                    std::cos(0.5f * static_cast<float>(y) + l.y);
    const float glossy =
        std::pow(std::max(glm::dot(glm::normalize(glm::vec3(-v.x, -v.y, v.z + 0.3f)), l), 0.0f), 15.0f);
    return l.z * (glm::vec3(0.5f, 0.3f, 0.2f) * relief + glm::vec3(0.4f * glossy));
  });
  FitOptions options;
  options.model.name = model;
  options.cosineInModel = cosineInModel;
  return std::make_shared<const ReflectanceField>(valueOf(fitReflectanceField(source, options)).field);
}

// Whose numbers a file rounds to halfs, and a GPU to bytes.
TEST_F(GpuAgainstCpu, AgreeOnFittedLobes) {
  const auto field = glossyReliefField(false, "loom_gloss");
  float largest = 0.0f;
  for (int x = 0; x < 8; ++x) largest = std::max(largest, field->shared().at(x, 3, 6));
  ASSERT_GT(largest, 0.1f) << "the root of a lobe's amount";
  expectAgreement(field, 0.0, 20, 2e-3f);
}

TEST_F(BTFMaterialTest, NearestViewIsTheOneOfTheLargestWeight) {
  const auto field = glossyReliefField();
  const auto layers = layersOnTheGpu(*field);
  const Frame frame = frameSeenFrom(glm::normalize(glm::vec3(0.3f, 0.4f, 0.7f)));
  const glm::vec3 towardsLight = frame.axes * glm::normalize(glm::vec3(-0.5f, 0.2f, 0.6f));
  const FloatImage expected =
      referencePicture(*field, frame, towardsLight, [&](glm::vec3 light, glm::vec3 view) {
        const int nearest = layers(light, view).nearest();
        return DirectionWeights{{nearest, nearest, nearest}, {1.0f, 0.0f, 0.0f}};
      });
  // Pixels on the border between two views may fall to either.
  expectEqualPictures(
      render({.interpolatedViews = 1, .filter = TexelFilter::Nearest}, field, frame, towardsLight), expected,
      5e-4f, 0.002);
}

TEST_F(BTFMaterialTest, AFieldThatContainsTheCosineFadesBelowTheMeasuredLights) {
  const auto field = glossyReliefField(true);
  const auto layers = layersOnTheGpu(*field);
  const Frame frame = frameSeenFrom(glm::normalize(glm::vec3(-0.2f, 0.1f, 0.9f)));
  for (double theta : {70.0, 80.0, 88.0, 95.0}) {
    const glm::vec3 towardsLight = frame.axes * directionFromDegrees(theta, 200);
    const FloatImage expected = referencePicture(*field, frame, towardsLight, layers);
    expectEqualPictures(render({.filter = TexelFilter::Nearest}, field, frame, towardsLight), expected,
                        5e-4f);
  }
}

TEST_F(BTFMaterialTest, BilinearMixesTheResultsOfFourTexelsAcrossTheEdgesToo) {
  const auto field = glossyReliefField();
  const auto layers = layersOnTheGpu(*field);
  const Frame frame = frameSeenFrom(glm::normalize(glm::vec3(0.2f, -0.3f, 0.8f)));
  const glm::vec3 towardsLight = frame.axes * glm::normalize(glm::vec3(0.4f, 0.3f, 0.5f));
  const glm::vec3 light = frame.toFrame(towardsLight);
  FloatImage expected(kPictureSize, kPictureSize, {"R", "G", "B", "A"});
  for (int y = 0; y < kPictureSize; ++y)
    for (int x = 0; x < kPictureSize; ++x) {
      const glm::vec3 view = frame.toFrame(glm::normalize(glm::vec3(0, 0, 2) - pixelPosition(x, y)));
      const DirectionWeights weights = layers(light, view);
      const glm::vec2 place = glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) * 8.0f /
                                  static_cast<float>(kPictureSize) -
                              0.5f;
      const glm::vec2 low = glm::floor(place);
      glm::vec3 value(0.0f);
      for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
          const float weight = (1.0f - std::abs(place.x - low.x - static_cast<float>(dx))) *
                               (1.0f - std::abs(place.y - low.y - static_cast<float>(dy)));
          value += weight * field->evaluate((static_cast<int>(low.x) + dx + 8) % 8,
                                            (static_cast<int>(low.y) + dy + 8) % 8, weights, light, view);
        }
      for (int c = 0; c < 3; ++c) expected.at(x, y, c) = value[c];
      expected.at(x, y, 3) = 1.0f;
    }
  expectEqualPictures(render({}, field, frame, towardsLight), expected, 5e-4f);
}

TEST_F(BTFMaterialTest, TexturesRepeat) {
  const auto field = glossyReliefField();
  const Frame upright{glm::mat3(1.0f)};
  const glm::vec3 towardsLight(0.3f, 0.2f, 0.9f);
  // A view so far away that it is the same for all pixels.
  const auto far = [&](glm::vec2 scale) {
    auto material =
        valueOf(BTFMaterial::create(field, {.textureScale = scale, .filter = TexelFilter::Nearest}));
    const RenderTarget target(kPictureSize, kPictureSize, Precision::Float);
    Camera camera = Camera::lookAt({0, 0, 1000}, {0, 0, 0});
    camera.verticalFieldOfView = 2.0f * std::atan(0.001f);
    camera.nearPlane = 900.0f;
    camera.farPlane = 1100.0f;
    EXPECT_TRUE(
        renderer.render(context(), *scene(material, squareWithFrame(upright), towardsLight), camera, target));
    return target.read(context());
  };
  const FloatImage once = far({1.0f, 1.0f});
  const FloatImage twice = far({2.0f, 1.0f});
  for (int y = 0; y < kPictureSize; y += 5)
    for (int x = 0; x < kPictureSize; x += 3) {
      EXPECT_NEAR(twice.at(x, y, 0), twice.at((x + kPictureSize / 2) % kPictureSize, y, 0), 1e-3f);
      EXPECT_NEAR(twice.at(x, y, 0), once.at(2 * x % kPictureSize, y, 0), 1e-3f);
    }
}

// Four levels of which every number is another, of a surface without relief.
ReflectanceField fieldWithLevels(const char* name) {
  const ReflectanceField finest = unevenField({name, {{"components", 8}}}, 8, 8);
  FieldTables tables = finest.tables();
  for (float& number : tables.at("registration").values()) number = 0.0f;
  std::vector<FieldLevel> levels;
  for (int side = 8; side >= 1; side /= 2) {
    FloatImage shared = unevenNumbers(side, side, finest.shared().channels(), 1, Precision::Half);
    roundAsFiltered(shared);
    levels.push_back({std::move(shared), {}});
  }
  const auto model = valueOf(ModelRegistry::builtin().create(finest.model().description()));
  return valueOf(ReflectanceField::create(model, finest.description(), levels, tables));
}

class FilteredLevels : public BTFMaterialTest, public testing::WithParamInterface<const char*> {};

// A pixel that covers 2^n texels shows a texel of level n.
TEST_P(FilteredLevels, AreThoseThatFit) {
  const auto field = std::make_shared<const ReflectanceField>(fieldWithLevels(GetParam()));
  const auto layers = layersOnTheGpu(*field);
  const Frame frame = frameSeenFrom(glm::normalize(glm::vec3(0.2f, -0.3f, 0.8f)));
  const glm::vec3 towardsLight = frame.axes * glm::normalize(glm::vec3(0.4f, 0.3f, 0.5f));
  const glm::vec3 light = frame.toFrame(towardsLight);
  for (int level = 0; level < 4; ++level) {
    const FloatImage& shared = field->levels()[static_cast<std::size_t>(level)].shared;
    const float repetitions = static_cast<float>(kPictureSize) / static_cast<float>(shared.width());
    FloatImage expected(kPictureSize, kPictureSize, {"R", "G", "B", "A"});
    for (int y = 0; y < kPictureSize; ++y)
      for (int x = 0; x < kPictureSize; ++x) {
        const glm::vec3 view = frame.toFrame(glm::normalize(glm::vec3(0, 0, 2) - pixelPosition(x, y)));
        const DirectionWeights weights = layers(light, view);
        glm::vec3 value(0.0f);
        for (int k = 0; k < 3; ++k)
          value += weights.weight[k] *
                   field->formula().evaluate(
                       shared.texel(x % shared.width(), y % shared.height()),
                       field->formula().layerOf({}, weights.index[static_cast<std::size_t>(k)]), light, view);
        for (int c = 0; c < 3; ++c) expected.at(x, y, c) = value[c];
        expected.at(x, y, 3) = 1.0f;
      }
    SCOPED_TRACE(level);
    expectEqualPictures(render({.textureScale = glm::vec2(repetitions)}, field, frame, towardsLight),
                        expected, 5e-3f);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, FilteredLevels, testing::Values("loom", "loom_gloss"));

std::shared_ptr<const ReflectanceField> whiteField(const char* model, bool cosineInData) {
  const MemoryBtf source(
      2, 2, [&](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(cosineInData ? l.z : 1.0f); },
      cosineInData);
  FitOptions options;
  options.model.name = model;
  return std::make_shared<const ReflectanceField>(valueOf(fitReflectanceField(source, options)).field);
}

TEST_F(BTFMaterialTest, WhiteIsTheCosineAtEveryAngleWithAndWithoutItInTheData) {
  // loom's base colours are kept to a 512th.
  for (const auto& [model, tolerance] : {std::pair("rfp", 1e-3f), {"rfnl", 1e-3f}, {"loom", 2e-3f}})
    for (bool cosineInData : {true, false}) {
      auto material = valueOf(BTFMaterial::create(whiteField(model, cosineInData)));
      for (int theta = 0; theta <= 95; theta += 5) {
        const glm::vec3 light = directionFromDegrees(theta, 33);
        const FloatImage image = picture(*scene(material, square(), light));
        for (int y = 0; y < image.height(); ++y)
          for (int x = 0; x < image.width(); ++x)
            EXPECT_NEAR(image.at(x, y, 1), std::max(light.z, 0.0f), tolerance) << model << " " << theta;
      }
    }
}

// Units (models.md): value 1 is a white Lambertian surface, whatever the light.
TEST_F(BTFMaterialTest, WhiteLooksLikeAWhiteLambertianSurface) {
  auto btf = valueOf(BTFMaterial::create(whiteField("rfnl", true)));
  const auto lambert = std::make_shared<LambertMaterial>();
  const auto under = [&](std::shared_ptr<const Material> material, std::shared_ptr<const NodeCore> light,
                         const glm::mat4& place) {
    auto root = std::make_shared<Node>();
    root->addChild(dressed(std::move(material)));
    root->addChild(std::make_shared<Transform>(place))->addChild(std::move(light));
    return picture(*root, 32, 32);
  };
  const auto point = std::make_shared<PointLight>(glm::vec3(3.0f, 2.0f, 1.0f));
  glm::mat4 place(1.0f);
  place[3] = glm::vec4(0.5f, -0.7f, 0.8f, 1.0f);
  expectEqualPictures(under(btf, point, place), under(lambert, point, place), 1e-3f);
  const auto directional = std::make_shared<DirectionalLight>(glm::vec3(1.0f, 2.0f, 3.0f));
  const glm::mat4 turned = shiningFrom({0.4f, 0.2f, 0.5f});
  expectEqualPictures(under(btf, directional, turned), under(lambert, directional, turned), 1e-3f);
}

// What a bump-mapped field shows is what glTF's material of the same numbers shows.
TEST_F(BTFMaterialTest, BumpIsAMetallicRoughnessMaterial) {
  const glm::vec3 normal = directionFromDegrees(25, 130);
  const glm::vec2 p = parabolicFromDirection(normal);
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "bump"}));
  FloatImage shared(1, 1, model->sharedChannels());
  std::ranges::copy(std::array{1.0f, 1.0f, 1.0f, 0.3f, p.x, p.y, 0.45f}, shared.texel(0, 0).begin());
  ReflectanceFieldDescription description;
  description.views = {{0, 0, 1}};
  description.lights = {directionFromDegrees(89, 0)};
  description.hasCosine = true;
  auto bump = valueOf(BTFMaterial::create(std::make_shared<const ReflectanceField>(
      valueOf(ReflectanceField::create(model, description, std::move(shared), {})))));

  const auto pbr = std::make_shared<PBRMaterial>(
      PBROptions{.baseColor = glm::vec4(glm::vec3(0.3f), 1.0f), .metallic = 0.0f, .roughness = 0.45f});
  auto tilted = square();
  tilted->normals.assign(4, normal);
  for (glm::vec3 light :
       {directionFromDegrees(10, 0), directionFromDegrees(40, 120), directionFromDegrees(80, 300)})
    expectEqualPictures(picture(*scene(bump, square(), light)), picture(*scene(pbr, tilted, light)), 1e-3f);
}

// What changes without packing or uploading anything.
TEST_F(BTFMaterialTest, ChangedOptionsShowWhatANewMaterialOfThemShows) {
  const auto textures = valueOf(BTFTextures::create(unevenField({.name = "rfnl"}, 8, 8)));
  const auto material = valueOf(BTFMaterial::create(textures));
  const auto root = scene(material, square(), {0.3f, 0.2f, 0.9f});
  FloatImage last = picture(*root, 32, 32);
  for (const BTFMaterialOptions& options :
       {BTFMaterialOptions{.textureScale = {2, 3}}, BTFMaterialOptions{.tint = {0.5f, 2, 0}},
        BTFMaterialOptions{.exposure = -1.5f}, BTFMaterialOptions{.interpolatedViews = 1},
        BTFMaterialOptions{.filter = TexelFilter::Nearest}, BTFMaterialOptions{},
        BTFMaterialOptions{.doubleSided = true}}) {
    requireDone(material->setOptions(options));
    const FloatImage changed = picture(*root, 32, 32);
    const auto fresh = scene(valueOf(BTFMaterial::create(textures, options)), square(), {0.3f, 0.2f, 0.9f});
    expectEqualPictures(changed, picture(*fresh, 32, 32), 0.0f);
    if (!options.doubleSided) {
      EXPECT_GT(compareImages(changed, last, 1e-3f).failingShare, 0.1);
    }
    last = changed;
  }
  for (const auto& [slot, chunk] : textures->chunks()) EXPECT_EQ(material->state().at(slot), chunk.get());
}

TEST_F(BTFMaterialTest, TintAndExposureMultiplyWhatIsShown) {
  const auto textures = valueOf(BTFTextures::create(*glossyReliefField()));
  const auto shown = [&](const BTFMaterialOptions& options) {
    return picture(*scene(valueOf(BTFMaterial::create(textures, options)), square(), {0, 0, 1}), 16, 16);
  };
  const FloatImage plain = shown({});
  const FloatImage tinted = shown({.tint = {0.5f, 0.25f, 2.0f}, .exposure = 1.0f});
  const glm::vec3 factors(1.0f, 0.5f, 4.0f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(tinted.at(x, y, c), factors[c] * plain.at(x, y, c), 1e-6f);
}

TEST_F(BTFMaterialTest, WrongOptionsAreRefused) {
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.interpolatedViews = 2}));
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.textureScale = {1, -1}}));
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.textureScale = {0, 1}}));
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.textureScale = {INFINITY, 1}}));
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.tint = {1, -1, 1}}));
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.tint = {1, NAN, 1}}));
  EXPECT_FALSE(BTFMaterial::create(glossyReliefField(), {.exposure = 1000.0f}));
  const auto material = valueOf(BTFMaterial::create(glossyReliefField(), {.exposure = 1.0f}));
  EXPECT_FALSE(material->setOptions({.interpolatedViews = 2}));
  EXPECT_EQ(material->options().interpolatedViews, 3);
  EXPECT_EQ(material->options().exposure, 1.0f);
}

}  // namespace
}  // namespace weft::test
