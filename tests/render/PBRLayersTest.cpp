// What Khronos' extensions lay on glTF's material: coats, sheen, grooves, films and thin glass.

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "EnvironmentReference.h"
#include "EvenLight.h"
#include "GlTest.h"
#include "LitSquare.h"
#include "TestSupport.h"
#include "weft/core/Color.h"
#include "weft/core/Direction.h"
#include "weft/core/ImageComparison.h"
#include "weft/materials/LightFromEnvironment.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

std::shared_ptr<Node> lampAt(glm::vec3 place, glm::vec3 intensity) {
  auto node = std::make_shared<Node>(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), place)));
  node->addChild(std::make_shared<PointLight>(intensity));
  return node;
}

std::shared_ptr<const TextureChunk> oneTexel(glm::u8vec4 texel, bool srgb = false) {
  auto image = std::make_shared<Image>(1, 1, 4);
  for (int channel = 0; channel < 4; ++channel)
    image->bytes[static_cast<std::size_t>(channel)] = texel[channel];
  return std::make_shared<TextureChunk>(std::shared_ptr<const Image>(image),
                                        TextureOptions{.wrap = TextureWrap::Repeat, .srgb = srgb});
}

/// The options with one of the layers, or with all.
enum class Layer { Coat, Sheen, Grooves, Film, Glass, All };

PBROptions withLayer(Layer layer, PBROptions options, float roughness = 0.3f) {
  const auto has = [&](Layer each) { return layer == each || layer == Layer::All; };
  if (has(Layer::Coat)) options.clearcoat = {.factor = 0.8f, .roughness = roughness};
  if (has(Layer::Sheen)) options.sheen = {.color = {0.9f, 0.5f, 0.3f}, .roughness = roughness};
  if (has(Layer::Grooves)) options.anisotropy = {.strength = 0.7f, .rotation = 0.6f};
  if (has(Layer::Film))
    options.iridescence = {.factor = 0.9f, .refractiveIndex = 1.4f, .maximumThickness = 350.0f};
  if (has(Layer::Glass)) options.transmission.factor = 0.6f;
  return options;
}

constexpr Layer kLayers[] = {Layer::Coat, Layer::Sheen, Layer::Grooves,
                             Layer::Film, Layer::Glass, Layer::All};

class PBRLayersTest : public GlTest {
 protected:
  static constexpr int kSize = 12;

  FloatImage pictureOf(const PBROptions& options) {
    auto root = dressed(std::make_shared<PBRMaterial>(options));
    for (const PlacedLight& lamp : kLamps) root->addChild(lampAt(lamp.place, lamp.intensity));
    return picture(*root, kSize, kSize, {.background = glm::vec4(0.0f)});
  }

  SheenTable table;
};

TEST_F(PBRLayersTest, EqualTheSpecificationAtEveryPixel) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  const auto color = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  float worst = 0.0f;
  for (int round = 0; round < 30; ++round) {
    PBROptions options;
    options.baseColor = glm::vec4(color(), 1.0f);
    options.metallic = round % 3 == 0 ? 0.0f : uniform(random);
    options.roughness = 0.15f + 0.85f * uniform(random);
    options.specular = round % 2 == 0 ? 1.0f : uniform(random);
    options.emission = round % 4 == 0 ? color() : glm::vec3(0.0f);
    const int which = round % 6;
    if (which == 0 || which == 5)
      options.clearcoat = {.factor = uniform(random), .roughness = 0.15f + 0.85f * uniform(random)};
    if (which == 1 || which == 5) options.sheen = {.color = color(), .roughness = uniform(random)};
    if (which == 2 || which == 5)
      options.anisotropy = {.strength = uniform(random), .rotation = 6.0f * uniform(random)};
    if (which == 3 || which == 5)
      options.iridescence = {.factor = uniform(random),
                             .refractiveIndex = 1.0f + uniform(random),
                             .maximumThickness = 1000.0f * uniform(random)};
    if (which == 4 || which == 5) options.transmission.factor = uniform(random);
    const float found = worstDifference(pictureOf(options), expectedSquare(options, kSize));
    EXPECT_LT(found, 2e-3f) << round;
    worst = std::max(worst, found);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST_F(PBRLayersTest, ThatTexturesTakeAwayChangeNothing) {
  const PBROptions plain{.baseColor = {0.9f, 0.5f, 0.2f, 1.0f},
                         .metallic = 0.4f,
                         .roughness = 0.4f,
                         .emission = glm::vec3(0.1f)};
  const FloatImage expected = pictureOf(plain);
  const auto black = oneTexel({0, 0, 0, 255}), white = oneTexel(glm::u8vec4(255));
  for (const Layer layer : kLayers) {
    PBROptions options = withLayer(layer, plain);
    const auto differenceWith = [&](const std::shared_ptr<const TextureChunk>& image) {
      for (PBRTexture* texture :
           {&options.clearcoat.texture, &options.sheen.colorTexture, &options.anisotropy.texture,
            &options.iridescence.texture, &options.transmission.texture})
        texture->image = image;
      return compareImages(pictureOf(options), expected).maximum;
    };
    EXPECT_GT(differenceWith(white), 1e-2f) << int(layer);
    EXPECT_LT(differenceWith(black), 1e-3f) << int(layer);
  }
}

// A material that has none is compiled without them.
TEST_F(PBRLayersTest, OfFactorZeroAreThePlainMaterial) {
  PBROptions options{.metallic = 0.0f};
  options.clearcoat.roughness = 0.5f;
  options.sheen.roughness = 0.5f;
  options.anisotropy.rotation = 1.0f;
  const PBRMaterial material(options), plain(PBROptions{.metallic = 0.0f});
  EXPECT_TRUE(*material.state().at(ProgramSlot) == *plain.state().at(ProgramSlot));
  EXPECT_FALSE(material.state().at(BlendSlot));
}

TEST_F(PBRLayersTest, MultiplyTheirTextures) {
  const PBROptions plain{.baseColor = {0.9f, 0.5f, 0.2f, 1.0f}, .metallic = 0.3f, .roughness = 0.4f};
  PBROptions textured = withLayer(Layer::All, plain, 0.8f), factors = textured;
  const float half = 128.0f / 255.0f;
  textured.clearcoat.texture.image = oneTexel({128, 0, 0, 0});
  textured.clearcoat.roughnessTexture.image = oneTexel({0, 128, 0, 0});
  textured.sheen.colorTexture.image = oneTexel({188, 90, 255, 0}, true);
  textured.sheen.roughnessTexture.image = oneTexel({0, 0, 0, 128});
  textured.anisotropy.texture.image = oneTexel({128, 255, 128, 0});  // along the bitangent
  textured.iridescence.texture.image = oneTexel({128, 0, 0, 0});
  textured.iridescence.thicknessTexture.image = oneTexel({0, 128, 0, 0});
  textured.transmission.texture.image = oneTexel({128, 0, 0, 0});
  factors.clearcoat.factor *= half;
  factors.clearcoat.roughness *= half;
  const auto linear = [](int byte) { return decode(Encoding::Srgb, static_cast<float>(byte) / 255.0f); };
  factors.sheen.color *= glm::vec3(linear(188), linear(90), 1.0f);
  factors.sheen.roughness *= half;
  factors.anisotropy.strength *= half;
  factors.anisotropy.rotation += std::atan2(1.0f, 2.0f * half - 1.0f);
  factors.iridescence.factor *= half;
  factors.iridescence.maximumThickness = glm::mix(100.0f, factors.iridescence.maximumThickness, half);
  factors.transmission.factor *= half;
  const FloatImage expected = pictureOf(factors);
  EXPECT_LT(worstDifference(pictureOf(textured), expected), 2e-3f);
  for (PBRTexture* texture : texturesOf(textured)) {
    if (!texture->image) continue;
    const auto image = std::exchange(texture->image, oneTexel(glm::u8vec4(255)));
    EXPECT_GT(worstDifference(pictureOf(textured), expected), 3e-3f) << "each texture matters";
    texture->image = image;
  }
}

TEST_F(PBRLayersTest, ACoatHasItsOwnNormal) {
  PBROptions options{.baseColor = {0.9f, 0.5f, 0.2f, 1.0f}, .roughness = 0.4f};
  options.clearcoat = {.factor = 1.0f, .roughness = 0.3f, .normalScale = 0.7f};
  options.clearcoat.normalTexture.image = oneTexel({204, 100, 230, 255});
  const glm::dvec3 mapped = 2.0 * glm::dvec3(204, 100, 230) / 255.0 - 1.0;
  const glm::dvec3 coatNormal =
      glm::normalize(mapped * glm::dvec3(options.clearcoat.normalScale, options.clearcoat.normalScale, 1));
  const FloatImage expected = expectedSquare(options, kSize, coatNormal);
  EXPECT_LT(worstDifference(pictureOf(options), expected), 2e-3f);
  EXPECT_GT(worstDifference(expectedSquare(options, kSize), expected), 0.1f);
}

TEST_F(PBRLayersTest, HighlightsAreLongAlongTheirDirection) {
  PBROptions options{.roughness = 0.2f, .anisotropy = {.strength = 0.6f}};
  const auto spread = [&](const FloatImage& image) {
    glm::dvec2 sum(0.0);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x)
        sum += double{image.at(x, y, 0)} * glm::dvec2(std::abs(x - 11.5), std::abs(y - 11.5));
    return sum.x / sum.y;
  };
  const auto shown = [&] {
    auto root = dressed(std::make_shared<PBRMaterial>(options));
    root->addChild(lampAt({0, 0, 1.5f}, glm::vec3(1)));
    return picture(*root, 24, 24, {.background = glm::vec4(0.0f)});
  };
  EXPECT_GT(spread(shown()), 1.5);
  options.anisotropy.rotation = kPi / 2;
  EXPECT_LT(spread(shown()), 0.67);
}

// ---- Energy
// ----------------------------------------------------------------------------------------------

TEST(SheenTable, HoldsWhatTheFormulaReflectsInAll) {
  const SheenTable table;
  for (const double roughness : {0.25, 0.5, 1.0})
    for (const double cosine : {0.2, 0.5, 1.0}) {
      constexpr int kSteps = 96;
      const glm::dvec3 v(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i)
        for (int k = 0; k < kSteps; ++k) {
          const double step = (i + 0.5) / kSteps, z = step * step, across = std::sqrt(1.0 - z * z);
          const double phi = glm::pi<double>() * (k + 0.5) / kSteps;
          const glm::dvec3 l(across * std::cos(phi), across * std::sin(phi), z);
          sum += step * z * sheenReflectance(roughness, v, l);
        }
      EXPECT_NEAR(table.at(static_cast<float>(cosine), static_cast<float>(roughness)),
                  sum * 4.0 * glm::pi<double>() / (kSteps * kSteps), 0.004)
          << roughness << ' ' << cosine;
    }
}

/// What the formulas give back of light that is 1 from everywhere.
double reflectedInAll(const PBROptions& options, const SheenTable& table, double cosine) {
  constexpr int kRings = 64, kAzimuths = 32;
  const glm::dvec3 v(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
  glm::dvec3 sum(0.0);
  for (int ring = 0; ring < kRings; ++ring)
    for (int k = 0; k < kAzimuths; ++k) {
      const double step = (ring + 0.5) / kRings, z = step * step, across = std::sqrt(1.0 - z * z);
      const double phi = glm::pi<double>() * (2.0 * k + 1.0) / kAzimuths;
      const glm::dvec3 l(across * std::cos(phi), across * std::sin(phi), z);
      sum += step * shownOfLight(options, table, v, l);
    }
  return maximumOf(sum) * 4.0 * glm::pi<double>() / (kRings * kAzimuths);
}

// Where the material without the layer gives back more than it gets (appendix B does so at grazing
// angles, where half directions do not tell how much enters), that is the bound.
TEST_F(PBRLayersTest, GiveBackNoMoreLightThanTheyGet) {
  for (const float metallic : {0.0f, 1.0f})
    for (const float roughness : {0.4f, 0.7f, 1.0f})
      for (const double cosine : {0.1, 0.4, 0.9}) {
        const PBROptions plain{.metallic = metallic, .roughness = roughness};
        const double bound = std::max(1.0, reflectedInAll(plain, table, cosine));
        for (const Layer layer : kLayers) {
          PBROptions options = withLayer(layer, plain, roughness);
          options.sheen.color *= 1.0f / 0.9f;
          EXPECT_LT(reflectedInAll(options, table, cosine), bound + 0.01)
              << int(layer) << ' ' << metallic << ' ' << roughness << ' ' << cosine << ' ' << bound;
        }
      }
}

/// Everything an environment shows of a layer, by sums over its texels.
glm::dvec3 trueSum(const PBROptions& options, const SheenTable& table,
                   const EnvironmentReference& environment, const glm::mat3& axes, glm::dvec3 v) {
  return glm::dvec3(environment.shown(
      axes, [&](glm::vec3 l) { return glm::vec3(glm::pi<double>() * shownOfLight(options, table, v, l)); }));
}

class PBRLayersInEnvironmentTest : public PBRLayersTest {
 protected:
  FloatImage inEnvironment(const PBROptions& options, std::shared_ptr<const Node> light,
                           std::shared_ptr<const Mesh> mesh, const Camera& camera, int side) {
    Node scene;
    scene.addChild(dressed(std::make_shared<PBRMaterial>(options), std::move(mesh)));
    scene.addChild(std::const_pointer_cast<Node>(light));
    const RenderTarget target(side, side, Precision::Float);
    EXPECT_TRUE(renderer.render(context(), scene, camera, target));
    return target.read(context());
  }
};

TEST_F(PBRLayersInEnvironmentTest, WhiteInWhiteIsNoBrighter) {
  const auto light = std::make_shared<Node>(evenLight());
  const auto sphere = std::make_shared<const Mesh>(makeSphere(32));
  for (const Layer layer : kLayers)
    for (const float metallic : {0.0f, 1.0f})
      for (const float roughness : {0.1f, 0.5f, 1.0f}) {
        const PBROptions options =
            withLayer(layer, {.metallic = metallic, .roughness = roughness}, roughness);
        const FloatImage image =
            inEnvironment(options, light, sphere, Camera::lookAt({1, 2, 2.5f}, {0, 0, 0}), 24);
        const auto [lowest, highest] = std::ranges::minmax(image.values());
        EXPECT_LT(highest, 1.005f) << int(layer) << ' ' << metallic << ' ' << roughness;
        EXPECT_GT(lowest, 0.1f);
      }
}

// What the formulas of environments approximate; docs/gltf.md has the figures.
TEST_F(PBRLayersInEnvironmentTest, ComesCloseToTheTrueSums) {
  constexpr int kSide = 4;
  const Environment environment = Environment::builtin("studio")->reduced(32, 16);
  const EnvironmentReference reference(environment);
  const auto light = makeEnvironmentLight(environment, PrefilteredEnvironment::create(environment));
  // Upwards, to a side, and leaning.
  const glm::mat4 turns[] = {glm::rotate(glm::mat4(1.0f), kPi / 2, {1, 0, 0}),
                             glm::rotate(glm::mat4(1.0f), 2.0f, {0.3f, 0.9f, 0.1f}),
                             glm::rotate(glm::mat4(1.0f), 4.0f, {0.6f, 0.2f, 0.7f})};
  for (const Layer layer : kLayers) {
    double error = 0.0, whole = 0.0;
    for (const float metallic : {0.0f, 1.0f})
      for (const glm::mat4& turn : turns) {
        PBROptions options = withLayer(
            layer, {.baseColor = {0.6f, 0.4f, 0.2f, 1}, .metallic = metallic, .roughness = 0.4f}, 0.4f);
        options.transmission.factor = 0.0f;  // so glass is the plain material
        auto turned = std::make_shared<Node>(std::make_shared<Transform>(turn));
        turned->addChild(light);
        const FloatImage actual = inEnvironment(options, turned, test::square(), squareCamera(), kSide);
        const glm::mat3 axes = glm::transpose(glm::mat3(turn));
        for (int y = 0; y < kSide; ++y)
          for (int x = 0; x < kSide; ++x) {
            const glm::dvec3 point((x + 0.5) * 2.0 / kSide - 1.0, 1.0 - (y + 0.5) * 2.0 / kSide, 0.0);
            const glm::dvec3 expected =
                trueSum(options, table, reference, axes, glm::normalize(glm::dvec3(0, 0, 2) - point));
            for (int channel = 0; channel < 3; ++channel) {
              error += std::abs(actual.at(x, y, channel) - expected[channel]);
              whole += expected[channel];
            }
          }
      }
    RecordProperty("layer_" + std::to_string(int(layer)), std::to_string(error / whole));
    EXPECT_LT(error / whole, 0.15) << int(layer);
  }
}

// ---- Thin glass
// ------------------------------------------------------------------------------------------

class PBRGlassTest : public PBRLayersTest {
 protected:
  /// Glass before a wall that glows.
  glm::vec4 throughGlass(const PBROptions& options, glm::vec3 wall) {
    Node root;
    root.addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 0.1f))))
        ->addChild(dressed(std::make_shared<PBRMaterial>(options)));
    root.addChild(
        dressed(std::make_shared<PBRMaterial>(PBROptions{.baseColor = glm::vec4(wall, 1), .unlit = true})));
    const FloatImage image = picture(root, 9, 9, {.background = glm::vec4(0.0f)});
    return {image.at(4, 4, 0), image.at(4, 4, 1), image.at(4, 4, 2), image.at(4, 4, 3)};
  }
  /// Compares with what passes, head-on.
  void expectPassing(const PBROptions& options, glm::vec3 share) {
    const glm::vec3 wall(0.8f, 0.6f, 0.4f);
    const glm::vec4 seen = throughGlass(options, wall);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(seen[channel], wall[channel] * share[channel], 1e-4f) << channel;
    EXPECT_NEAR(seen.a, 1.0f, 1e-5f);
  }

  const glm::vec3 tint{0.9f, 0.5f, 0.2f};
  PBROptions glass{.baseColor = glm::vec4(tint, 1), .metallic = 0.0f, .transmission = {.factor = 0.75f}};
};

TEST_F(PBRGlassTest, ShowsWhatIsBehindTinted) {
  expectPassing(glass, 0.96f * 0.75f * tint);  // 4 % are mirrored
  glass.specular = 0.0f;
  expectPassing(glass, 0.75f * tint);
  glass.metallic = 0.5f;
  expectPassing(glass, 0.375f * tint);
  glass.transmission.factor = 0.0f;
  expectPassing(glass, glm::vec3(0.0f));
}

TEST_F(PBRGlassTest, LayersKeepTheirShare) {
  glass.specular = 0.0f;
  glass.clearcoat = {.factor = 0.5f};
  expectPassing(glass, 0.98f * 0.75f * tint);
  glass.sheen = {.color = {0.5f, 0.2f, 0.1f}, .roughness = 0.8f};
  expectPassing(glass, (1.0f - 0.5f * table.at(1.0f, 0.8f)) * 0.98f * 0.75f * tint);
}

TEST_F(PBRGlassTest, CoversWhatAlphaSays) {
  glass.specular = 0.0f;
  glass.baseColor.a = 0.4f;
  glass.alphaMode = AlphaMode::Blend;
  expectPassing(glass, 0.6f + 0.4f * 0.75f * tint);
  glass.alphaMode = AlphaMode::Mask;
  expectPassing(glass, glm::vec3(1.0f));
  glass.baseColor.a = 0.6f;
  expectPassing(glass, 0.75f * tint);
}

TEST_F(PBRGlassTest, MetalLetsNothingPassAndIsNotBlended) {
  glass.metallic = 1.0f;
  EXPECT_FALSE(PBRMaterial(glass).state().at(BlendSlot));
  EXPECT_FALSE(PBRMaterial(glass).coverage());
  expectPassing(glass, glm::vec3(0.0f));
}

}  // namespace
}  // namespace weft::test
