// What RenderOptions::shown shows instead of light.

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "ConstantField.h"
#include "EvenLight.h"
#include "GlTest.h"
#include "TestSupport.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

constexpr int kShownPixels = 32;
constexpr double kSphereRadius = 0.8;

std::shared_ptr<const Material> measuredMaterial(const std::filesystem::path& folder, glm::vec3 color) {
  writeConstantField(folder / "field.rf.exr", color);
  return valueOf(loadBTFMaterial(folder / "field.rf.exr", {.textureScale = glm::vec2(3.0f)}));
}

class ShownValueTest : public GlTest {
 protected:
  /// A sphere in light of all kinds, none of which may matter.
  FloatImage shown(ShownValue value, std::shared_ptr<const Material> material, const Camera& camera) {
    Node root;
    root.addChild(std::make_shared<Transform>(
                      glm::scale(glm::mat4(1.0f), glm::vec3(static_cast<float>(kSphereRadius)))))
        ->addChild(dressed(std::move(material), sphere));
    root.addChild(std::make_shared<PointLight>(glm::vec3(9)));
    root.addChild(environment);
    const RenderTarget target(kShownPixels, kShownPixels, Precision::Float);
    EXPECT_TRUE(
        renderer.render(context(), root, camera, target, {.background = glm::vec4(0.0f), .shown = value}));
    return target.read(context());
  }

  std::shared_ptr<EnvironmentLight> environment = evenLight();
  std::shared_ptr<const Mesh> sphere = std::make_shared<const Mesh>(makeSphere(64));
};

/// Where the ray of a pixel meets the sphere, and how far along the view that is; false where it
/// does not, or only just.
struct SphereHit {
  glm::dvec3 point{0.0};
  double depth = 0.0;
  bool isHit = false;
};

SphereHit sphereHit(const Camera& camera, int x, int y) {
  const glm::dmat4 fromClip = glm::inverse(glm::dmat4(camera.projection(1.0f)) * glm::dmat4(camera.view));
  const auto unprojected = [&](double z) {
    const glm::dvec4 p = fromClip * glm::dvec4((x + 0.5) * 2.0 / kShownPixels - 1.0,
                                               1.0 - (y + 0.5) * 2.0 / kShownPixels, z, 1.0);
    return glm::dvec3(p) / p.w;
  };
  const glm::dvec3 near = unprojected(-1.0), ray = glm::normalize(unprojected(1.0) - near);
  const double along = -glm::dot(near, ray);
  const double inside = kSphereRadius * kSphereRadius - glm::dot(near, near) + along * along;
  SphereHit hit;
  if (inside < 0.05) return hit;
  hit.isHit = true;
  hit.point = near + (along - std::sqrt(inside)) * ray;
  hit.depth = -(glm::dmat4(camera.view) * glm::dvec4(hit.point, 1.0)).z;
  return hit;
}

TEST_F(ShownValueTest, NormalsAndDepthsAreThoseOfTheSphere) {
  const auto folder = testFolder();
  Camera orthographic = Camera::lookAt({1, 2, 2.5f}, {0.1f, 0, 0});
  orthographic.orthographicHeight = 2.0f;
  for (const Camera& camera : {Camera::lookAt({1, 1, 1.5f}, {0.1f, 0, 0}), orthographic})
    for (const auto& material : {std::shared_ptr<const Material>(std::make_shared<LambertMaterial>()),
                                 std::shared_ptr<const Material>(std::make_shared<PBRMaterial>(PBROptions{
                                     .baseColor = {1, 1, 1, 0.2f}, .alphaMode = AlphaMode::Blend})),
                                 std::shared_ptr<const Material>(std::make_shared<PBRMaterial>(
                                     PBROptions{.metallic = 0.0f, .transmission = {.factor = 0.9f}})),
                                 measuredMaterial(folder, glm::vec3(0.5f))}) {
      const FloatImage normals = shown(ShownValue::Normal, material, camera);
      const FloatImage depths = shown(ShownValue::Depth, material, camera);
      int hits = 0;
      for (int y = 0; y < kShownPixels; ++y)
        for (int x = 0; x < kShownPixels; ++x) {
          const SphereHit hit = sphereHit(camera, x, y);
          if (!hit.isHit) continue;
          ++hits;
          for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(normals.at(x, y, channel), hit.point[channel] / kSphereRadius, 0.01);
          ASSERT_NEAR(depths.at(x, y, 0), hit.depth, 0.003);
          ASSERT_EQ(depths.at(x, y, 3), 1.0f);
        }
      EXPECT_GT(hits, 100);
      EXPECT_EQ(depths.at(0, 0, 3), 0.0f) << "no environment is shown";
    }
}

TEST_F(ShownValueTest, AlbedoIsTheDiffusePart) {
  const auto middle = [&](std::shared_ptr<const Material> material) {
    const FloatImage image =
        shown(ShownValue::Albedo, std::move(material), Camera::lookAt({0, 0, 3}, {0, 0, 0}));
    return glm::vec3(image.at(16, 16, 0), image.at(16, 16, 1), image.at(16, 16, 2));
  };
  const glm::vec3 color(0.8f, 0.4f, 0.1f);
  const auto expectColor = [&](glm::vec3 value, float share) {
    for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(value[channel], share * color[channel], 0.004f);
  };
  PBROptions options{.baseColor = glm::vec4(color, 1), .metallic = 0.0f, .emission = glm::vec3(1)};
  expectColor(middle(std::make_shared<PBRMaterial>(options)), 0.96f);
  options.metallic = 1.0f;
  expectColor(middle(std::make_shared<PBRMaterial>(options)), 0.0f);
  options.unlit = true;
  expectColor(middle(std::make_shared<PBRMaterial>(options)), 1.0f);
  expectColor(middle(std::make_shared<LambertMaterial>(LambertOptions{.baseColor = glm::vec4(color, 1)})),
              1.0f);
  expectColor(middle(measuredMaterial(testFolder(), color)), 1.0f);
}

// A normal texture leans the normal, and does not darken the albedo.
TEST_F(ShownValueTest, NormalTexturesLeanTheNormal) {
  auto image = std::make_shared<Image>(1, 1, 3);
  image->bytes = {204, 128, 230};
  PBROptions options{.metallic = 0.0f, .specular = 0.0f};
  options.normalTexture.image = std::make_shared<TextureChunk>(std::shared_ptr<const Image>(image));
  auto root = dressed(std::make_shared<PBRMaterial>(options));
  const auto at = [&](ShownValue value) {
    const FloatImage seen = picture(*root, 9, 9, {.background = glm::vec4(0.0f), .shown = value});
    return glm::vec3(seen.at(4, 4, 0), seen.at(4, 4, 1), seen.at(4, 4, 2));
  };
  const glm::vec3 n = glm::normalize(2.0f * glm::vec3(204, 128, 230) / 255.0f - 1.0f);
  EXPECT_NEAR(glm::distance(at(ShownValue::Normal), n), 0.0f, 1e-4f);
  EXPECT_NEAR(glm::distance(at(ShownValue::Albedo), glm::vec3(1)), 0.0f, 1e-3f);
}

TEST_F(ShownValueTest, TextureCoordinatesAreScaledAsTheMaterialIs) {
  const auto at = [&](std::shared_ptr<const Material> material) {
    auto root = dressed(std::move(material));
    const FloatImage seen =
        picture(*root, 8, 8, {.background = glm::vec4(0.0f), .shown = ShownValue::TextureCoordinates});
    return glm::vec2(seen.at(6, 1, 0), seen.at(6, 1, 1));
  };
  const glm::vec2 place(6.5f / 8, 1.5f / 8);
  EXPECT_NEAR(glm::distance(at(std::make_shared<PBRMaterial>()), place), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::distance(at(std::make_shared<LambertMaterial>()), place), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::distance(at(measuredMaterial(testFolder(), glm::vec3(0.5f))), 3.0f * place), 0.0f, 1e-5f);
}

}  // namespace
}  // namespace weft::test
