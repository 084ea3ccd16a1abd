#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "GlTest.h"
#include "weft/core/Color.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

using test::kPi;

class LambertTest : public test::GlTest {
 protected:
  /// A square below a transform, the light not.
  std::shared_ptr<Node> scene(const LambertOptions& options, std::shared_ptr<const NodeCore> light,
                              const glm::mat4& model = glm::mat4(1.0f)) {
    auto root = std::make_shared<Node>();
    root->addChild(std::move(light));
    root->addChild(std::make_shared<Transform>(model))
        ->addChild(test::dressed(std::make_shared<LambertMaterial>(options)));
    return root;
  }

  /// Under light of irradiance pi along -Z, from the viewer.
  std::shared_ptr<Node> sceneFromViewer(const LambertOptions& options,
                                        const glm::mat4& model = glm::mat4(1.0f)) {
    return scene(options, std::make_shared<DirectionalLight>(glm::vec3(kPi)), model);
  }
};

/// A light's node turned so that its -Z axis points along `direction` (not along Y).
std::shared_ptr<Node> turnedLight(glm::vec3 direction, glm::vec3 irradiance) {
  const glm::mat4 turn = glm::inverse(glm::lookAt(glm::vec3(0), direction, glm::vec3(0, 1, 0)));
  auto node = std::make_shared<Node>(std::make_shared<Transform>(turn));
  node->addChild(std::make_shared<DirectionalLight>(irradiance));
  return node;
}

TEST_F(LambertTest, WhiteFacingIrradiancePiShowsOne) {
  const FloatImage image = picture(*sceneFromViewer({}));
  for (const float value : image.values()) EXPECT_NEAR(value, 1.0f, 1e-3f);
}

TEST_F(LambertTest, DirectionalLightFollowsTheCosineToTheHorizon) {
  for (const float degrees : {0.0f, 30.0f, 60.0f, 85.0f, 89.9f, 95.0f}) {
    const float theta = glm::radians(degrees);
    auto root = test::dressed(std::make_shared<LambertMaterial>());
    root->addChild(turnedLight({-std::sin(theta), 0, -std::cos(theta)}, glm::vec3(kPi, 2 * kPi, 0.5f * kPi)));
    const FloatImage image = picture(*root, 2, 2);
    const float cosine = std::max(std::cos(theta), 0.0f);
    EXPECT_NEAR(image.at(0, 0, 0), cosine, 1e-5f) << degrees;
    EXPECT_NEAR(image.at(0, 0, 1), 2.0f * cosine, 1e-5f) << degrees;
    EXPECT_NEAR(image.at(0, 0, 2), 0.5f * cosine, 1e-5f) << degrees;
  }
}

TEST_F(LambertTest, PointLightFallsOffWithTheSquareOfTheDistance) {
  const glm::vec3 place(0.3f, -0.2f, 0.7f);
  auto root = test::dressed(std::make_shared<LambertMaterial>());
  root->addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1.0f), place)))
      ->addChild(std::make_shared<PointLight>(glm::vec3(5.0f)));
  const FloatImage image = picture(*root);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const glm::vec3 point((static_cast<float>(x) + 0.5f) / 4.0f - 1.0f,
                            1.0f - (static_cast<float>(y) + 0.5f) / 4.0f, 0.0f);
      const float distance = glm::distance(point, place);
      EXPECT_NEAR(image.at(x, y, 0), 5.0f / kPi * place.z / std::pow(distance, 3.0f), 1e-4f);
    }
}

TEST_F(LambertTest, LightsAddUp) {
  auto root = sceneFromViewer({});
  root->addChild(std::make_shared<DirectionalLight>(glm::vec3(kPi)));
  EXPECT_NEAR(picture(*root).at(3, 3, 0), 2.0f, 1e-4f);
}

TEST_F(LambertTest, BaseColorIsItsFactorTimesTheDecodedTexture) {
  // Red, green; blue, white quarters, a texel a pixel.
  constexpr std::uint8_t kQuarters[2][2][3] = {{{255, 0, 0}, {0, 188, 0}}, {{0, 0, 99}, {255, 255, 255}}};
  auto texture = std::make_shared<Image>(8, 8, 3);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) std::copy_n(kQuarters[y / 4][x / 4], 3, texture->pixel(x, y));
  const glm::vec4 factor(0.5f, 1.0f, 0.8f, 1.0f);
  const FloatImage image = picture(*sceneFromViewer({factor, texture}));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        const float stored = static_cast<float>(kQuarters[y][x][channel]) / 255.0f;
        EXPECT_NEAR(image.at(1 + 4 * x, 1 + 4 * y, channel), factor[channel] * decode(Encoding::Srgb, stored),
                    2e-3f)
            << x << ' ' << y << ' ' << channel;
      }
}

TEST_F(LambertTest, GreyTextureIsGrey) {
  auto texture = std::make_shared<Image>(1, 1, 1);
  texture->bytes = {188};
  const FloatImage image = picture(*sceneFromViewer({glm::vec4(1.0f), texture}));
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(image.at(4, 4, channel), decode(Encoding::Srgb, 188.0f / 255.0f), 2e-3f);
}

TEST_F(LambertTest, BackFacesShowOnlyWhenDoubleSidedAndAreLitFromTheirSide) {
  const glm::mat4 about = glm::rotate(glm::mat4(1.0f), kPi, glm::vec3(0, 1, 0));
  EXPECT_EQ(picture(*sceneFromViewer({}, about)).at(4, 4, 0), 0.0f);
  EXPECT_NEAR(picture(*sceneFromViewer({.doubleSided = true}, about)).at(4, 4, 0), 1.0f, 1e-3f);
  auto fromBehind = scene({.doubleSided = true}, std::make_shared<Group>(), about);
  fromBehind->addChild(turnedLight({0, 0, 1}, glm::vec3(kPi)));
  EXPECT_EQ(picture(*fromBehind).at(4, 4, 0), 0.0f);
}

TEST_F(LambertTest, MirroredThingsKeepTheirFrontFaces) {
  const glm::mat4 mirror = glm::scale(glm::mat4(1.0f), glm::vec3(-1, 1, 1));
  EXPECT_NEAR(picture(*sceneFromViewer({}, mirror)).at(4, 4, 0), 1.0f, 1e-3f);
  const glm::mat4 away = glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, -1));
  EXPECT_EQ(picture(*sceneFromViewer({}, away)).at(4, 4, 0), 0.0f);
}

TEST_F(LambertTest, NormalsStayPerpendicularUnderUnevenScaling) {
  // Turned by 45 degrees about Y, then stretched along Z: the plane's normal is (2, 0, 1) /
  // sqrt(5).
  const glm::mat4 model = glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, 2)) *
                          glm::rotate(glm::mat4(1.0f), kPi / 4, glm::vec3(0, 1, 0));
  EXPECT_NEAR(picture(*sceneFromViewer({}, model)).at(4, 4, 0), 1.0f / std::sqrt(5.0f), 1e-4f);
}

TEST_F(LambertTest, FlattenedThingsGiveNoNonsense) {
  const glm::mat4 flat = glm::scale(glm::mat4(1.0f), glm::vec3(1, 1, 0));
  const FloatImage image = picture(*sceneFromViewer({}, flat));
  for (const float value : image.values()) EXPECT_NEAR(value, 1.0f, 1e-3f);
}

}  // namespace
}  // namespace weft
