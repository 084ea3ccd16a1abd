#include "weft/materials/PBRMaterial.h"

#include <cmath>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/core/Color.h"
#include "weft/core/Direction.h"
#include "weft/core/ImageComparison.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

using test::kPi;

// ---- The formulas of glTF 2.0, appendix B, as printed there, in double precision
// --------------------------

double heaviside(double x) {
  return x > 0.0 ? 1.0 : 0.0;
}

double squareOf(double x) {
  return x * x;
}

double distribution(double alpha, double nh) {
  const double squared = alpha * alpha;
  return squared * heaviside(nh) / (glm::pi<double>() * squareOf(squareOf(nh) * (squared - 1.0) + 1.0));
}

glm::dvec3 appendixB(const PBROptions& material, glm::dvec3 n, glm::dvec3 v, glm::dvec3 l) {
  const glm::dvec3 h = glm::normalize(l + v);
  const double nl = glm::dot(n, l), nv = glm::dot(n, v), hl = glm::dot(h, l), hv = glm::dot(h, v);
  const double alpha = squareOf(material.roughness);
  const auto root = [&](double x) { return std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * x * x); };
  const double shadowing = 2.0 * nl * nv * heaviside(hl) * heaviside(hv) / (nl * root(nv) + nv * root(nl));
  const double specular = shadowing * distribution(alpha, glm::dot(n, h)) / (4.0 * nl * nv);
  const glm::dvec3 base(material.baseColor);
  const double schlick = std::pow(1.0 - std::abs(hv), 5.0);
  const glm::dvec3 metal = specular * (base + (1.0 - base) * schlick);
  const double f0 = squareOf((material.refractiveIndex - 1.0) / (material.refractiveIndex + 1.0));
  const glm::dvec3 dielectricF0 =
      glm::min(f0 * glm::dvec3(material.specularColor), glm::dvec3(1.0)) * double{material.specular};
  const glm::dvec3 fresnel = dielectricF0 + (double{material.specular} - dielectricF0) * schlick;
  const double strongest = std::max({fresnel.x, fresnel.y, fresnel.z});
  const glm::dvec3 dielectric = (1.0 - strongest) * base / glm::pi<double>() + fresnel * specular;
  return glm::mix(dielectric, metal, double{material.metallic});
}

/// Turns a node's -Z, along which a light shines, against `towardsLight` (not along Y).
glm::mat4 lookingAlong(glm::vec3 towardsLight) {
  return glm::inverse(glm::lookAt(glm::vec3(0), -towardsLight, glm::vec3(0, 1, 0)));
}

std::shared_ptr<Node> sun(glm::vec3 towardsLight, glm::vec3 irradiance) {
  auto node = std::make_shared<Node>(std::make_shared<Transform>(lookingAlong(towardsLight)));
  node->addChild(std::make_shared<DirectionalLight>(irradiance));
  return node;
}

std::shared_ptr<Node> lamp(glm::vec3 place, glm::vec3 intensity) {
  auto node = std::make_shared<Node>(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), place)));
  node->addChild(std::make_shared<PointLight>(intensity));
  return node;
}

/// Shines along -Z, on a part of what is there.
std::shared_ptr<Node> spot(glm::vec3 place) {
  auto node = std::make_shared<Node>(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), place)));
  node->addChild(std::make_shared<SpotLight>(glm::vec3(3, 4, 5), 0.2f, 0.4f));
  return node;
}

std::shared_ptr<const TextureChunk> texture(std::vector<glm::u8vec4> texels, int width, bool srgb = false) {
  auto image = std::make_shared<Image>(width, static_cast<int>(texels.size()) / width, 4);
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (int channel = 0; channel < 4; ++channel)
      image->bytes[4 * i + static_cast<std::size_t>(channel)] = texels[i][channel];
  return std::make_shared<TextureChunk>(std::shared_ptr<const Image>(image),
                                        TextureOptions{.wrap = TextureWrap::Repeat, .srgb = srgb});
}

class PBRMaterialTest : public test::GlTest {
 protected:
  FloatImage pictureOf(const PBROptions& options, const std::vector<std::shared_ptr<Node>>& lights,
                       std::shared_ptr<const Mesh> mesh = test::square(), int size = 8) {
    auto root = test::dressed(std::make_shared<PBRMaterial>(options), std::move(mesh));
    for (const auto& light : lights) root->addChild(light);
    return picture(*root, size, size, {.background = glm::vec4(0.0f)});
  }

  /// One colour of a facing square under light that shows white as 1.
  glm::vec4 colorOf(const PBROptions& options, std::shared_ptr<const Mesh> mesh = test::square()) {
    const FloatImage image = pictureOf(options, {sun({0, 0, 1}, glm::vec3(kPi))}, std::move(mesh));
    return {image.at(4, 4, 0), image.at(4, 4, 1), image.at(4, 4, 2), image.at(4, 4, 3)};
  }
};

/// The point of the square in the middle of a pixel.
glm::vec3 pointAt(int x, int y, int size) {
  const float step = 2.0f / static_cast<float>(size);
  return {(static_cast<float>(x) + 0.5f) * step - 1.0f, 1.0f - (static_cast<float>(y) + 0.5f) * step, 0.0f};
}

TEST_F(PBRMaterialTest, EqualsAppendixBAtEveryPixel) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  const auto color = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
  constexpr int kSize = 24;
  float worst = 0.0f, brightest = 0.0f;
  for (int round = 0; round < 40; ++round) {
    PBROptions options;
    options.baseColor = glm::vec4(color(), 1.0f);
    options.metallic = round % 4 == 0 ? 0.0f : round % 4 == 1 ? 1.0f : uniform(random);
    options.roughness = 0.15f + 0.85f * uniform(random);
    options.specular = round % 3 == 0 ? 1.0f : uniform(random);
    options.specularColor = round % 3 == 0 ? glm::vec3(1.0f) : color();
    options.refractiveIndex = round % 5 == 0 ? 1.0f + uniform(random) : 1.5f;
    options.emission = round % 7 == 0 ? color() : glm::vec3(0.0f);
    const glm::vec3 place(2.0f * uniform(random) - 1.0f, 2.0f * uniform(random) - 1.0f,
                          0.2f + uniform(random));
    const glm::vec3 direction = directionFromDegrees(85.0 * uniform(random), 360.0 * uniform(random));
    const glm::vec3 intensity = color(), irradiance = color();
    const FloatImage image =
        pictureOf(options, {lamp(place, intensity), sun(direction, irradiance)}, test::square(), kSize);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const glm::dvec3 point = pointAt(x, y, kSize), n(0, 0, 1);
        const glm::dvec3 v = glm::normalize(glm::dvec3(0, 0, 2) - point);
        const glm::dvec3 offset = glm::dvec3(place) - point, toLamp = glm::normalize(offset);
        const glm::dvec3 toSun = glm::normalize(glm::dvec3(direction));
        const glm::dvec3 expected =
            glm::dvec3(options.emission) +
            glm::dvec3(irradiance) * toSun.z * appendixB(options, n, v, toSun) +
            glm::dvec3(intensity) / glm::dot(offset, offset) * toLamp.z * appendixB(options, n, v, toLamp);
        for (int channel = 0; channel < 3; ++channel) {
          const double value = expected[channel];
          const double error = std::abs(image.at(x, y, channel) - value) / std::max(1.0, value);
          worst = std::max(worst, static_cast<float>(error));
          brightest = std::max(brightest, static_cast<float>(value));
        }
      }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-3f);
  EXPECT_GT(brightest, 2.0f) << "there are highlights in the pictures";
}

/// What a white hemisphere of light gives back, by 64 x 16 suns.
float albedo(const std::function<FloatImage(const std::vector<std::shared_ptr<Node>>&)>& show) {
  constexpr int kRings = 64, kAzimuths = 16;
  float sum = 0.0f;
  for (int ring = 0; ring < kRings; ++ring) {
    // Rings of equal steps in cos^2, each of which carries as much irradiance: n.l dl = pi
    // d(cos^2).
    const float z = std::sqrt((static_cast<float>(ring) + 0.5f) / kRings);
    std::vector<std::shared_ptr<Node>> suns;
    for (int k = 0; k < kAzimuths; ++k) {
      const float phi = 2.0f * kPi * (static_cast<float>(k) + 0.25f) / kAzimuths;
      const float radius = std::sqrt(1.0f - z * z);
      const glm::vec3 l(radius * std::cos(phi), radius * std::sin(phi), z);
      suns.push_back(sun(l, glm::vec3(kPi / (kRings * kAzimuths) / z)));
    }
    sum += show(suns).at(0, 0, 1);
  }
  return sum;
}

TEST_F(PBRMaterialTest, GivesBackNoMoreLightThanItGets) {
  const auto albedoOf = [&](const PBROptions& options) {
    return albedo([&](const auto& suns) { return pictureOf(options, suns, test::square(), 1); });
  };
  EXPECT_NEAR(albedoOf({.metallic = 0.0f, .specular = 0.0f}), 1.0f, 1e-3f) << "a white diffuse surface";
  // White microfacets lose what is scattered more than once. Of alpha 1 and seen from above, D V is
  // 1 / (2 pi (1 + n.l)), the integral of whose product with n.l is 1 - log 2.
  EXPECT_NEAR(albedoOf({.metallic = 1.0f, .roughness = 1.0f}), 1.0f - std::log(2.0f), 1e-3f);
  float previous = 0.0f;
  for (const float roughness : {1.0f, 0.8f, 0.6f, 0.5f}) {
    const float metal = albedoOf({.metallic = 1.0f, .roughness = roughness});
    EXPECT_LT(metal, 1.005f) << roughness;
    EXPECT_GT(metal, previous) << "smoother ones lose less, " << roughness;
    previous = metal;
    const float dielectric = albedoOf({.metallic = 0.0f, .roughness = roughness});
    EXPECT_LT(dielectric, 1.005f) << roughness;
    EXPECT_GT(dielectric, 0.9f) << roughness;
  }
}

/// Value 1 at every angle: a white Lambertian surface.
std::shared_ptr<const BTFMaterial> whiteBtf() {
  const auto model = test::valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  FloatImage shared(1, 1, model->sharedChannels()), views(1, 1, model->layerChannels(), 1);
  for (int channel = 0; channel < 3; ++channel) shared.at(0, 0, channel) = 1.0f;
  views.at(0, 0, 5) = 1.0f;
  ReflectanceFieldDescription description;
  description.views = {{0, 0, 1}};
  description.lights = {{0, 0, 1}, directionFromDegrees(60, 0), directionFromDegrees(60, 90)};
  return test::valueOf(BTFMaterial::create(std::make_shared<const ReflectanceField>(
      test::valueOf(ReflectanceField::create(model, description, std::move(shared), std::move(views))))));
}

// A dielectric also mirrors, which no Lambertian surface does; KHR_materials_specular = 0 leaves
// the matt part.
TEST_F(PBRMaterialTest, WhiteWithoutHighlightsLooksLikeAWhiteBtf) {
  const auto btf = whiteBtf();
  const auto pbr = std::make_shared<PBRMaterial>(PBROptions{.metallic = 0.0f, .specular = 0.0f});
  const auto sphere = std::make_shared<const Mesh>(makeSphere(24));
  std::vector<std::shared_ptr<Node>> lights{sun({0.4f, 0.2f, 0.5f}, {1, 2, 3}),
                                            sun({-1, 0.2f, 0.1f}, {3, 2, 1}),
                                            lamp({0.5f, -0.7f, 1.2f}, {3, 2, 1}), spot({0.2f, 0.3f, 2.5f})};
  for (const auto& light : lights) {
    const auto under = [&](std::shared_ptr<const Material> material) {
      auto root = test::dressed(std::move(material), sphere);
      root->addChild(light);
      return picture(*root, 48, 48);
    };
    const FloatImage expected = under(btf);
    EXPECT_LT(compareImages(under(pbr), expected).maximum, 1e-3f);
    EXPECT_GT(expected.at(24, 24, 0), 0.05f);
  }
}

TEST_F(PBRMaterialTest, FactorsMultiplyTexturesAndVertexColors) {
  auto mesh = test::square();
  mesh->colors.assign(4, {0.5f, 0.25f, 1.0f, 1.0f});
  PBROptions options{.baseColor = {0.8f, 0.4f, 0.6f, 1.0f}, .metallic = 0.0f, .specular = 0.0f};
  options.baseColorTexture.image = texture({{188, 99, 255, 255}}, 1, true);
  const auto linear = [](int byte) { return decode(Encoding::Srgb, static_cast<float>(byte) / 255.0f); };
  const glm::vec4 color = colorOf(options, mesh);
  EXPECT_NEAR(color.r, 0.8f * 0.5f * linear(188), 2e-3f);
  EXPECT_NEAR(color.g, 0.4f * 0.25f * linear(99), 2e-3f);
  EXPECT_NEAR(color.b, 0.6f, 2e-3f);

  options.unlit = true;
  options.emission = {0.0f, 0.0f, 2.0f};
  options.emissionTexture.image = texture({{0, 0, 255, 255}}, 1, true);
  EXPECT_NEAR(colorOf(options, mesh).b, 2.6f, 2e-3f) << "emission has no upper end";
}

TEST_F(PBRMaterialTest, TexturesGiveRoughnessInGreenAndMetalInBlue) {
  PBROptions textured{.baseColor = {0.9f, 0.5f, 0.2f, 1.0f}, .metallic = 0.5f, .roughness = 0.8f};
  textured.metallicRoughnessTexture.image = texture({{255, 102, 204, 0}}, 1);
  PBROptions plain = textured;
  plain.metallicRoughnessTexture = {};
  plain.roughness *= 0.4f;
  plain.metallic *= 0.8f;
  const std::vector lights{lamp({0.3f, 0.2f, 0.8f}, glm::vec3(1.0f))};
  const ImageComparison difference = compareImages(pictureOf(textured, lights), pictureOf(plain, lights));
  EXPECT_LT(difference.maximum, 1e-4f);
}

TEST_F(PBRMaterialTest, AlphaModes) {
  PBROptions options{.baseColor = {1, 1, 1, 0.4f}, .metallic = 0.0f, .specular = 0.0f};
  EXPECT_NEAR(glm::distance(colorOf(options), glm::vec4(1.0f)), 0.0f, 1e-3f) << "opaque";
  options.alphaMode = AlphaMode::Mask;
  EXPECT_EQ(colorOf(options), glm::vec4(0.0f)) << "below the cutoff";
  options.alphaCutoff = 0.4f;
  EXPECT_NEAR(glm::distance(colorOf(options), glm::vec4(1.0f)), 0.0f, 1e-3f) << "at the cutoff";
  options.alphaMode = AlphaMode::Blend;
  EXPECT_NEAR(colorOf(options).r, 0.4f, 1e-3f) << "over black";
}

TEST_F(PBRMaterialTest, BlendedThingsDoNotHideWhatIsBehindThem) {
  const auto glass = std::make_shared<PBRMaterial>(
      PBROptions{.baseColor = {1, 0, 0, 0.5f}, .alphaMode = AlphaMode::Blend, .unlit = true});
  const auto wall = std::make_shared<PBRMaterial>(PBROptions{.baseColor = {0, 1, 0, 1}, .unlit = true});
  Node root;
  for (const float z : {0.1f, 0.2f})
    root.addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, z))))
        ->addChild(test::dressed(glass));
  root.addChild(test::dressed(wall));
  const FloatImage image = picture(root);
  EXPECT_NEAR(image.at(4, 4, 0), 0.75f, 1e-5f);
  EXPECT_NEAR(image.at(4, 4, 1), 0.25f, 1e-5f);
}

TEST_F(PBRMaterialTest, BackFacesShowOnlyWhenDoubleSidedWithTheirNormalsReversed) {
  PBROptions options{.metallic = 0.0f, .specular = 0.0f};
  // leans towards +x by 45 degrees
  options.normalTexture.image = texture({{255, 128, 255, 255}}, 1);
  auto mesh = test::square();
  for (std::size_t i = 0; i < 6; i += 3) std::swap(mesh->indices[i], mesh->indices[i + 1]);
  const std::vector lights{sun({0.6f, 0, 0.8f}, glm::vec3(kPi))};
  EXPECT_EQ(pictureOf(options, lights, mesh).at(4, 4, 0), 0.0f);
  options.doubleSided = true;
  // The normal of the front is (1, 0, 1) / sqrt(2); seen from behind, (-1, 0, -1) / sqrt(2).
  EXPECT_NEAR(pictureOf(options, lights, mesh).at(4, 4, 0), 0.0f, 1e-3f);
  const std::vector behind{sun({-0.6f, 0, -0.8f}, glm::vec3(kPi))};
  EXPECT_NEAR(pictureOf(options, behind, mesh).at(4, 4, 0), 1.4f / std::sqrt(2.0f), 5e-3f);
}

TEST_F(PBRMaterialTest, NormalTexturesTurnTheNormalByTheirScale) {
  PBROptions options{.metallic = 0.0f, .specular = 0.0f};
  options.normalTexture.image = texture({{204, 230, 255, 255}}, 1);
  for (const float scale : {0.0f, 0.5f, 1.0f, 2.0f}) {
    options.normalScale = scale;
    const glm::vec3 n =
        glm::normalize(glm::vec3(scale * (2 * 204 / 255.0f - 1), scale * (2 * 230 / 255.0f - 1), 1));
    for (const glm::vec3 l : {glm::vec3(0, 0, 1), glm::vec3(0.6f, 0, 0.8f), glm::vec3(0, 0.6f, 0.8f)}) {
      const FloatImage image = pictureOf(options, {sun(l, glm::vec3(kPi))});
      EXPECT_NEAR(image.at(4, 4, 0), glm::dot(n, l), 1e-3f) << scale;
    }
  }
}

/// A quad whose texture coordinates are already where the placement would put them, with the
/// tangent frame of these.
std::shared_ptr<Mesh> placedSquare(const TexturePlacement& placement) {
  auto mesh = test::square();
  const glm::mat2 matrix = placement.matrix(), frame = placement.tangentFrame();
  for (glm::vec2& uv : mesh->texcoords) uv = matrix * uv + placement.offset;
  for (glm::vec4& tangent : mesh->tangents) tangent = {frame[0].x, frame[0].y, 0, glm::determinant(frame)};
  return mesh;
}

TEST_F(PBRMaterialTest, PlacesEveryTextureAndTurnsTheFrameOfTheNormalTexture) {
  const TexturePlacement placements[] = {{.rotation = kPi / 2},
                                         {.rotation = 0.4f, .offset = {0.2f, -0.3f}},
                                         {.scale = {-1, 1}},
                                         {.scale = {2, -3}, .rotation = -1.0f}};
  const auto colors =
      texture({{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {90, 90, 90, 255}}, 2, true);
  const auto factors = texture({{0, 50, 0, 255}, {0, 250, 0, 255}, {0, 100, 255, 255}, {0, 200, 90, 255}}, 2);
  const auto normals =
      texture({{200, 128, 230, 255}, {128, 200, 230, 255}, {80, 100, 250, 255}, {128, 128, 255, 255}}, 2);
  const std::vector lights{lamp({0.3f, 0.5f, 0.8f}, glm::vec3(1.0f)), sun({0.6f, 0, 0.8f}, glm::vec3(1.0f))};
  for (const TexturePlacement& placement : placements) {
    PBROptions options;
    options.emission = glm::vec3(0.2f);
    for (PBRTexture* part : {&options.baseColorTexture, &options.emissionTexture})
      *part = {colors, placement};
    options.metallicRoughnessTexture = {factors, placement};
    options.normalTexture = {normals, placement};
    PBROptions unplaced = options;
    for (PBRTexture* part : {&unplaced.baseColorTexture, &unplaced.emissionTexture,
                             &unplaced.metallicRoughnessTexture, &unplaced.normalTexture})
      part->placement = {};
    // A size whose pixels avoid the edges of texels.
    const FloatImage actual = pictureOf(options, lights, test::square(), 31);
    const FloatImage expected = pictureOf(unplaced, lights, placedSquare(placement), 31);
    EXPECT_LT(compareImages(actual, expected, 1e-3f).failingShare, 0.01);
    const FloatImage different = pictureOf(unplaced, lights, test::square(), 31);
    EXPECT_GT(compareImages(actual, different, 1e-2f).failingShare, 0.3);
  }
}

TEST_F(PBRMaterialTest, TurnsTexturesCounterClockwise) {
  // A quarter turn of the coordinates shows the image turned clockwise: its left column (red over
  // blue, seen without) comes to the top.
  PBROptions options{.unlit = true};
  options.baseColorTexture.image =
      texture({{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}}, 2, true);
  options.baseColorTexture.placement = {.rotation = kPi / 2};
  const FloatImage image = pictureOf(options, {});
  EXPECT_GT(image.at(1, 1, 2), 0.9f) << "blue is at the upper left";
  EXPECT_LT(image.at(1, 1, 0), 0.1f);
  EXPECT_GT(image.at(6, 1, 0), 0.9f) << "red is at the upper right";
  EXPECT_LT(image.at(6, 1, 1), 0.1f);
}

TEST_F(PBRMaterialTest, UsesTheSetOfTextureCoordinatesThatTheTextureAsksFor) {
  auto mesh = test::square();
  mesh->texcoords1.assign(4, {0.75f, 0.25f});
  PBROptions options{.unlit = true};
  options.baseColorTexture.image =
      texture({{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}}, 2, true);
  options.baseColorTexture.placement.set = 1;
  const FloatImage image = pictureOf(options, {}, mesh);
  for (const int x : {1, 6}) EXPECT_EQ(image.at(x, 6, 1), 1.0f);
  for (const int x : {1, 6}) EXPECT_EQ(image.at(x, 6, 0), 0.0f);
}

TEST_F(PBRMaterialTest, SmoothMirrorsStayFinite) {
  const PBROptions options{.roughness = 0.0f};
  const FloatImage image =
      pictureOf(options, {sun({0, 0, 1}, glm::vec3(kPi)), lamp({0, 0, 2}, glm::vec3(1))});
  for (const float value : image.values()) EXPECT_LT(value, 65504.0f);
}

TEST_F(PBRMaterialTest, DrawsLinesAndPoints) {
  auto mesh = test::square();
  mesh->topology = Topology::Lines;
  mesh->positions = {{-1, 0.06f, 0}, {1, 0.06f, 0}, {0.06f, -1, 0}, {0.06f, 1, 0}};
  mesh->indices = {0, 1};
  const auto lit = [&](const FloatImage& image) {
    int count = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) count += image.at(x, y, 0) == 1.0f;
    return count;
  };
  const PBROptions options{.unlit = true};
  const FloatImage line = pictureOf(options, {}, mesh);
  EXPECT_EQ(lit(line), 8);
  EXPECT_EQ(line.at(1, 3, 0), 1.0f);
  mesh->topology = Topology::Points;
  mesh->positions = {{-0.6f, 0.6f, 0}, {0.1f, 0.1f, 0}, {0.6f, 0.6f, 0}, {5, 5, 0}};
  mesh->indices = {0, 1, 2, 3, 0};
  const FloatImage points = pictureOf(options, {}, std::make_shared<Mesh>(*mesh));
  EXPECT_EQ(lit(points), 3);
}

}  // namespace
}  // namespace weft
