#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "EnvironmentReference.h"
#include "EvenLight.h"
#include "GlTest.h"
#include "MemoryBtf.h"
#include "SomeModels.h"
#include "TestSupport.h"
#include "weft/baking/ReferenceRenderer.h"
#include "weft/core/ImageComparison.h"
#include "weft/fitter/FieldFit.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/LightFromEnvironment.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

/// Glossy and coloured, every view and light another value. One texel, because rays and pixels
/// disagree about where one ends.
std::shared_ptr<const ReflectanceField> fieldWithSheen(const ModelDescription& model,
                                                       bool cosineInModel = false, bool stored = false) {
  const MemoryBtf source(1, 1, [](int, int, glm::vec3 v, glm::vec3 l) {
    const float relief = 1.0f + 0.4f * std::sin(2.0f * l.x) * std::cos(l.y);
    const glm::vec3 mirrored = glm::normalize(glm::vec3(-v.x, -v.y, v.z + 0.3f));
    const float glossy = std::pow(std::max(glm::dot(mirrored, l), 0.0f), 30.0f);
    const float sheen =
        std::pow(std::max(glm::dot(glm::normalize(glm::vec3(0.6f, 0.3f, 0.5f)), l), 0.0f), 4.0f);
    return l.z * (glm::vec3(0.5f, 0.3f, 0.2f) * (relief + 0.5f * sheen) + glm::vec3(0.6f * glossy));
  });
  FitOptions options;
  options.model = model;
  options.cosineInModel = cosineInModel;
  if (stored) options.space = FitSpace::Stored;
  return std::make_shared<const ReflectanceField>(valueOf(fitReflectanceField(source, options)).field);
}

/// A small picture of an environment: sums over all of its texels are quick.
Environment smallEnvironment(const std::string& name) {
  std::vector<std::string> warnings;
  const auto builtin = Environment::builtin(name);
  return (builtin ? *builtin : valueOf(readEnvironment(dataFile("hdr/" + name + ".hdr"), warnings)))
      .reduced(64, 32);
}

class EnvironmentTest : public GlTest {
 protected:
  /// A sphere under an environment that is turned.
  FloatImage drawn(std::shared_ptr<const Material> material, std::shared_ptr<const EnvironmentLight> light) {
    Node scene;
    scene.addChild(dressed(std::move(material), mesh));
    auto turned = scene.addChild(std::make_shared<Transform>(turn()));
    turned->addChild(std::move(light));
    const RenderTarget target(size, size, Precision::Float);
    const auto rendered = renderer.render(context(), scene, camera(), target);
    EXPECT_TRUE(rendered) << rendered.error().message();
    return target.read(context());
  }
  static Camera camera() { return Camera::lookAt({1, 2, 2.5f}, {0, 0, 0}); }
  /// Around an axis of no special direction.
  static glm::mat4 turn() {
    return glm::mat4(glm::mat3(0.36f, 0.48f, -0.8f, -0.8f, 0.6f, 0.0f, 0.48f, 0.64f, 0.6f));
  }
  /// What all pixels of the sphere show, by ray tracing.
  FloatImage traced(const std::function<glm::vec3(const glm::mat3& axes, glm::vec3 view)>& shown) {
    ReferenceShot shot;
    shot.eye = {1, 2, 2.5f};
    shot.target = {0, 0, 0};
    shot.verticalFieldOfView = camera().verticalFieldOfView;
    shot.width = shot.height = size;
    shot.samples = 1;
    ReferenceMaterial material;
    material.surroundings = [&](int, int, const glm::mat3& axes, glm::vec3 view) {
      return shown(glm::transpose(glm::mat3(turn())) * axes, view);
    };
    return valueOf(ReferenceRenderer::create(
                       {mesh->positions, mesh->normals, mesh->tangents, mesh->texcoords, mesh->indices}))
        .render(shot, material);
  }

  int size = 48;  ///< of the pictures
  std::shared_ptr<const Mesh> mesh = std::make_shared<const Mesh>(makeSphere(32));
};

/// Differences relative to max(reference, 5 % of the picture's mean), over the pixels that
/// `expected` covers; as models.md asks.
struct Difference {
  double mean = 0.0, maximum = 0.0;
};

Difference difference(const FloatImage& actual, const FloatImage& expected) {
  double sum = 0.0;
  int count = 0;
  const auto forAll = [&](const auto& visit) {
    for (int y = 0; y < expected.height(); ++y)
      for (int x = 0; x < expected.width(); ++x) {
        bool inside = x > 0 && y > 0 && x + 1 < expected.width() && y + 1 < expected.height();
        for (int dy = -1; inside && dy <= 1; ++dy)  // silhouettes fall to either side
          for (int dx = -1; dx <= 1; ++dx) inside = inside && expected.at(x + dx, y + dy, 3) == 1.0f;
        for (int c = 0; inside && c < 3; ++c) visit(actual.at(x, y, c), expected.at(x, y, c));
      }
  };
  forAll([&](float, float reference) { sum += reference, ++count; });
  const double floor = 0.05 * sum / count;
  Difference result;
  forAll([&](float value, float reference) {
    const double relative = std::abs(value - reference) / std::max<double>(reference, floor);
    result.mean += relative / count;
    result.maximum =
        std::max(result.maximum, std::isnan(relative) ? std::numeric_limits<double>::infinity() : relative);
  });
  return result;
}

struct FitKind {
  ModelDescription model;
  bool cosineInModel = false;
  bool stored = false;
};

// The models of the list: those with the standard of their options and a formula for environments,
// or the rest. A PTM is of one view, and its formula is that of `rfp`.
std::vector<FitKind> kindsOf(bool usual) {
  const ModelRegistry registry = ModelRegistry::builtin();
  std::vector<FitKind> kinds;
  for (const ModelDescription& description : someModels()) {
    const auto model = valueOf(registry.create(description));
    const auto standard = valueOf(registry.create({.name = description.name}));
    const bool isUsual = model->description() == standard->description() && model->integratesEnvironments();
    if (description.name != "ptm" && isUsual == usual) kinds.push_back({description});
  }
  return kinds;
}

std::vector<FitKind> usualKinds() {
  return kindsOf(true);
}

std::vector<FitKind> otherKinds() {
  std::vector<FitKind> kinds = kindsOf(false);
  kinds.push_back({{.name = "rfp"}, true});
  kinds.push_back({{.name = "rfnl", .options = {{"lobes", 1}}}, false, true});
  return kinds;
}

std::string nameOf(const FitKind& kind) {
  return test::nameOf(kind.model) + (kind.cosineInModel ? " with cosine" : "") +
         (kind.stored ? " stored" : "");
}

// The GPU's pictures against sums over all texels, by the same formula.
class GpuAgainstSums : public EnvironmentTest, public testing::WithParamInterface<const char*> {
 protected:
  void compare(const std::vector<FitKind>& kinds, const Environment& environment) {
    const EnvironmentReference reference(environment);
    const PrefilteredEnvironment prefiltered = PrefilteredEnvironment::create(environment);
    Difference worst;
    for (const auto& [lookup, method] : {std::pair(LobeLookup::Fitted, LobeMethod::Fitted),
                                         std::pair(LobeLookup::Paper, LobeMethod::PaperRounded)}) {
      const auto light = makeEnvironmentLight(environment, prefiltered, lookup);
      for (const FitKind& kind : kinds) {
        SCOPED_TRACE(nameOf(kind) + (lookup == LobeLookup::Paper ? " paper" : ""));
        const auto field = fieldWithSheen(kind.model, kind.cosineInModel, kind.stored);
        // Prepared ones ask for the same, but that half precision rounds it.
        for (const bool prepared : {false, true}) {
          const FloatImage actual =
              drawn(valueOf(BTFMaterial::create(field, {.preparedForEnvironments = prepared})), light);
          const FloatImage expected = traced([&](const glm::mat3& axes, glm::vec3 view) {
            return field->underEnvironment(0, 0, view, EnvironmentReference::Light(reference, axes, method));
          });
          const Difference found = difference(actual, expected);
          EXPECT_LE(found.mean, 0.01);
          EXPECT_LE(found.maximum, 0.03);
          worst.mean = std::max(worst.mean, found.mean);
          worst.maximum = std::max(worst.maximum, found.maximum);
        }
      }
    }
    RecordProperty("worst_mean", std::to_string(worst.mean));  // for --gtest_output=xml
    RecordProperty("worst_maximum", std::to_string(worst.maximum));
  }
};

TEST_P(GpuAgainstSums, ShowTheSameFormula) {
  if (!Environment::builtin(GetParam())) {
    WEFT_DATA_FILE(file, std::string("hdr/") + GetParam() + ".hdr");
  }
  compare(usualKinds(), smallEnvironment(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Environments, GpuAgainstSums, testing::Values("studio", "sky", "venice", "city"));

TEST_F(GpuAgainstSums, ShowTheSameFormulaOfOtherFitsToo) {
  size = 12;  // some ask for averages around each of 81 lights
  compare(otherKinds(), smallEnvironment("studio"));
}

// What microfacets mirror, around a metal sphere.
TEST_F(EnvironmentTest, GltfsMaterialShowsTheSplitSum) {
  const Environment environment = smallEnvironment("studio");
  const EnvironmentReference reference(environment);
  const auto light = makeEnvironmentLight(environment, PrefilteredEnvironment::create(environment));
  for (const float roughness : {0.3f, 0.55f, 1.0f}) {
    SCOPED_TRACE(roughness);
    const glm::vec3 base(0.9f, 0.6f, 0.3f);
    const FloatImage actual =
        drawn(std::make_shared<PBRMaterial>(
                  PBROptions{.baseColor = glm::vec4(base, 1), .metallic = 0.5f, .roughness = roughness}),
              light);
    const FloatImage expected = traced([&](const glm::mat3& axes, glm::vec3 view) {
      const EnvironmentReference::Light seen(reference, axes, LobeMethod::True);
      const glm::vec3 n(0, 0, 1);
      const float entering = 1.0f - seen.glossyShare(n, view, roughness, 0.04f);
      const glm::vec3 dielectric = entering * base * seen.diffuse(n) + seen.glossy(n, view, roughness, 0.04f);
      glm::vec3 metal;
      for (int c = 0; c < 3; ++c) metal[c] = seen.glossy(n, view, roughness, base[c])[c];
      return 0.5f * (dielectric + metal);
    });
    const Difference found = difference(actual, expected);
    EXPECT_LE(found.mean, 0.01);
    EXPECT_LE(found.maximum, 0.03);
  }
}

void expectWhite(const FloatImage& picture, float tolerance) {
  // background and alpha are 1, too
  const auto [lowest, highest] = std::ranges::minmax(picture.values());
  EXPECT_GE(lowest, 1.0f - tolerance);
  EXPECT_LE(highest, 1.0f + tolerance);
}

// A sphere has every tilt.
TEST_F(EnvironmentTest, WhiteInWhiteIsInvisible) {
  const Environment white = Environment::constant(glm::vec3(1.0f));
  const PrefilteredEnvironment prefiltered = PrefilteredEnvironment::create(white);
  for (const LobeLookup lookup : {LobeLookup::Fitted, LobeLookup::Paper}) {
    const auto light = makeEnvironmentLight(white, prefiltered, lookup);
    std::vector<FitKind> kinds = usualKinds();
    std::ranges::copy(otherKinds(), std::back_inserter(kinds));
    for (const FitKind& kind : kinds) {
      SCOPED_TRACE(nameOf(kind));
      const MemoryBtf source(1, 1, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(l.z); });
      FitOptions options;
      options.model = kind.model;
      options.cosineInModel = kind.cosineInModel;
      if (kind.stored) options.space = FitSpace::Stored;
      const auto field =
          std::make_shared<const ReflectanceField>(valueOf(fitReflectanceField(source, options)).field);
      // A bump map mirrors what dielectrics do, which its fit makes up for under the measured
      // lights alone.
      const float tolerance = kind.model.name == "bump" ? 0.025f : 0.005f;
      expectWhite(drawn(valueOf(BTFMaterial::create(field)), light), tolerance);
    }
    expectWhite(drawn(std::make_shared<LambertMaterial>(), light), 0.002f);
    expectWhite(drawn(std::make_shared<PBRMaterial>(PBROptions{.metallic = 0.0f, .specular = 0.0f}), light),
                0.002f);
    // What a dielectric does not mirror enters it, and a white one returns that.
    expectWhite(drawn(std::make_shared<PBRMaterial>(PBROptions{.metallic = 0.0f, .roughness = 0.4f}), light),
                0.002f);
  }
}

FloatImage sumOf(FloatImage a, const FloatImage& b) {
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      for (int c = 0; c < 3; ++c) a.at(x, y, c) += b.at(x, y, c);
  return a;
}

TEST_F(EnvironmentTest, DiffuseAndSpecularAddUpAndPointLightsToo) {
  const auto light = evenLight();
  light->intensity = {0.2f, 0.5f, 0.9f};
  light->showsBackground = false;
  const auto draw = [&](std::shared_ptr<const Material> material, bool surroundings, bool lamp,
                        ReflectedPart part) {
    Node scene;
    scene.addChild(dressed(std::move(material), mesh));
    if (surroundings) scene.addChild(light);
    if (lamp) scene.addChild(std::make_shared<DirectionalLight>(glm::vec3(2.0f)));
    const RenderTarget target(size, size, Precision::Float);
    RenderOptions options;
    options.background = glm::vec4(0.0f);
    options.part = part;
    EXPECT_TRUE(renderer.render(context(), scene, camera(), target, options));
    return target.read(context());
  };
  std::vector<std::shared_ptr<const Material>> materials{
      std::make_shared<PBRMaterial>(PBROptions{.metallic = 0.3f, .roughness = 0.5f}),
      std::make_shared<LambertMaterial>()};
  for (const FitKind& kind : usualKinds())
    materials.push_back(valueOf(BTFMaterial::create(fieldWithSheen(kind.model))));
  for (const auto& material : materials) {
    const auto part = [&](ReflectedPart each) { return draw(material, true, true, each); };
    const FloatImage all = part(ReflectedPart::All);
    EXPECT_LE(compareImages(sumOf(part(ReflectedPart::Diffuse), part(ReflectedPart::Specular)), all).maximum,
              1e-3f);
    EXPECT_LE(compareImages(sumOf(draw(material, true, false, ReflectedPart::All),
                                  draw(material, false, true, ReflectedPart::All)),
                            all)
                  .maximum,
              1e-3f);
  }
}

// Each pixel of the background shows the direction in which it looks, whatever the projection and
// the turn.
TEST_F(EnvironmentTest, TheBackgroundLiesWhereItsLightComesFrom) {
  FloatImage picture(256, 128, {"R", "G", "B"});
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x) {
      const glm::vec3 d = Environment::direction((glm::vec2(x, y) + 0.5f) / glm::vec2(256, 128));
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = 0.5f + 0.5f * d[c];
    }
  std::vector<std::string> warnings;
  const Environment environment = valueOf(Environment::create(picture, warnings));
  EXPECT_TRUE(warnings.empty());
  const auto light = makeEnvironmentLight(environment, PrefilteredEnvironment::create(environment));
  Node scene;
  auto turned = scene.addChild(std::make_shared<Transform>(turn()));
  turned->addChild(light);
  for (const bool orthographic : {false, true}) {
    Camera from = camera();
    from.orthographicHeight = orthographic ? 2.0f : 0.0f;
    const RenderTarget target(size, size, Precision::Float);
    ASSERT_TRUE(renderer.render(context(), scene, from, target));
    const FloatImage drawnPicture = target.read(context());
    const glm::mat4 toClip = from.projection(1.0f) * from.view;
    for (const glm::ivec2 pixel : {glm::ivec2(0, 0), {24, 24}, {47, 3}, {10, 40}}) {
      const glm::vec2 place = (glm::vec2(pixel) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f;
      const glm::vec4 near = glm::inverse(toClip) * glm::vec4(place.x, -place.y, -1, 1);
      const glm::vec4 far = glm::inverse(toClip) * glm::vec4(place.x, -place.y, 1, 1);
      const glm::vec3 looks = glm::normalize(glm::vec3(far) / far.w - glm::vec3(near) / near.w);
      const glm::vec3 expected = 0.5f + 0.5f * (glm::transpose(glm::mat3(turn())) * looks);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawnPicture.at(pixel.x, pixel.y, c), expected[c], 0.01f);
    }
  }
}

TEST_F(EnvironmentTest, ASceneHasOneEnvironmentAtMost) {
  const auto light = evenLight();
  Node scene;
  scene.addChild(light);
  scene.addChild(light);
  const RenderTarget target(8, 8);
  EXPECT_FALSE(renderer.render(context(), scene, camera(), target));
}

// Transparent things show what is behind them: the environment, too.
TEST_F(EnvironmentTest, TheBackgroundShinesThroughGlass) {
  const auto light = evenLight();
  const FloatImage picture = drawn(
      std::make_shared<PBRMaterial>(PBROptions{
          .baseColor = {0, 0, 0, 0.25f}, .metallic = 0.0f, .specular = 0.0f, .alphaMode = AlphaMode::Blend}),
      light);
  EXPECT_NEAR(picture.at(size / 2, size / 2, 1), 0.75f, 0.01f);
  EXPECT_NEAR(picture.at(0, 0, 1), 1.0f, 1e-4f);
}

// Occlusion dims what comes from an environment.
TEST_F(EnvironmentTest, OcclusionDimsTheSurroundings) {
  const auto light = evenLight();
  auto half = std::make_shared<FloatImage>(1, 1, std::vector<std::string>{"R"});
  half->at(0, 0, 0) = 0.5f;
  PBROptions options{.metallic = 0.0f, .specular = 0.0f};
  options.occlusionTexture.image = std::make_shared<TextureChunk>(std::shared_ptr<const FloatImage>(half));
  options.occlusionStrength = 0.5f;
  EXPECT_NEAR(drawn(std::make_shared<PBRMaterial>(options), light).at(size / 2, size / 2, 0), 0.75f, 0.01f);
}

// No picture may make a frame that is none.
TEST_F(EnvironmentTest, BadPicturesAreWarnedAboutAndDrawn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  const auto material =
      valueOf(BTFMaterial::create(fieldWithSheen({.name = "rfnl", .options = {{"lobes", 2}}})));
  const auto mirror = std::make_shared<PBRMaterial>(PBROptions{.roughness = 0.0f});
  const auto cleaned = [&](const FloatImage& picture, std::size_t expectedWarnings) {
    std::vector<std::string> warnings;
    Environment environment = valueOf(Environment::create(picture, warnings));
    EXPECT_EQ(warnings.size(), expectedWarnings);
    for (const float value : environment.image().values()) EXPECT_TRUE(std::isfinite(value) && value >= 0.0f);
    return environment;
  };
  const auto draw = [&](const Environment& environment) {
    const auto light = makeEnvironmentLight(environment, PrefilteredEnvironment::create(environment));
    for (const std::shared_ptr<const Material>& each :
         {std::shared_ptr<const Material>(material), std::shared_ptr<const Material>(mirror)}) {
      const FloatImage shown = drawn(each, light);
      for (const float value : shown.values()) EXPECT_TRUE(std::isfinite(value) && value >= 0.0f);
    }
  };
  const auto grey = [](int width, int height) {
    FloatImage picture(width, height, {"R", "G", "B"});
    std::ranges::fill(picture.values(), 0.5f);
    return picture;
  };
  FloatImage broken = grey(16, 8);
  broken.at(3, 2, 0) = kNan;
  broken.at(4, 2, 0) = -kNan;
  broken.at(5, 5, 1) = kInfinite;
  broken.at(6, 6, 2) = -kInfinite;
  broken.at(7, 6, 2) = -3.0f;
  draw(cleaned(broken, 3));
  FloatImage nothing(4, 2, {"R", "G", "B"});
  std::ranges::fill(nothing.values(), kInfinite);
  cleaned(nothing, 1);
  cleaned(grey(1, 1), 0);
  cleaned(grey(7, 7), 1);
  FloatImage sun = grey(64, 32);
  for (int c = 0; c < 3; ++c) sun.at(40, 8, c) = 1e6f;
  draw(cleaned(sun, 0));
  FloatImage suns(1, 1, {"R", "G", "B"});
  std::ranges::fill(suns.values(), 1e6f);
  draw(cleaned(suns, 0));
}

}  // namespace
}  // namespace weft::test
