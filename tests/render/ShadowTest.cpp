#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/baking/ReferenceRenderer.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/io/ExrFile.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/PassiveWindow.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft::test {
namespace {

constexpr int kPixelsAcross = 192;
constexpr float kPi = glm::pi<float>();

Mesh moved(Mesh mesh, const glm::mat4& to) {
  for (glm::vec3& p : mesh.positions) p = glm::vec3(to * glm::vec4(p, 1.0f));
  for (glm::vec3& n : mesh.normals) n = glm::mat3(to) * n;
  for (glm::vec4& t : mesh.tangents) t = glm::vec4(glm::mat3(to) * glm::vec3(t), t.w);
  return mesh;
}

void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  mesh.tangents.insert(mesh.tangents.end(), more.tangents.begin(), more.tangents.end());
  mesh.texcoords.insert(mesh.texcoords.end(), more.texcoords.begin(), more.texcoords.end());
  for (const std::uint32_t index : more.indices) mesh.indices.push_back(first + index);
}

/// A ball that floats above a floor of side 6, and a post that stands on it.
Mesh ballOnFloor() {
  const glm::mat4 one(1.0f);
  Mesh mesh = moved(makePlane(), glm::rotate(glm::scale(one, glm::vec3(6.0f)), -0.5f * kPi, {1, 0, 0}));
  for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
  append(mesh, moved(makeSphere(48), glm::translate(one, {0, 1.3f, 0})));
  Mesh post = moved(makeSphere(32), glm::scale(glm::translate(one, {1.6f, 0, 0.8f}), {0.15f, 1.2f, 0.15f}));
  for (std::size_t i = 0; i < post.positions.size(); ++i) {
    const glm::vec3 p = post.positions[i] - glm::vec3(1.6f, 0, 0.8f);
    post.normals[i] = glm::normalize(p / glm::vec3(0.0225f, 1.44f, 0.0225f));
  }
  append(mesh, post);
  return mesh;
}

std::shared_ptr<const Material> white() {
  return std::make_shared<LambertMaterial>(
      LambertOptions{.baseColor = glm::vec4(1.0f), .baseColorTexture = nullptr, .doubleSided = true});
}

/// Whether a pixel differs, within two pixels, by more than what counts as an edge.
bool nearEdge(const FloatImage& image, int x, int y) {
  float low = image.at(x, y, 0), high = low;
  for (int j = std::max(y - 2, 0); j <= std::min(y + 2, image.height() - 1); ++j)
    for (int i = std::max(x - 2, 0); i <= std::min(x + 2, image.width() - 1); ++i) {
      low = std::min(low, image.at(i, j, 0));
      high = std::max(high, image.at(i, j, 0));
    }
  return high - low > 0.1f;
}

float displayed(float linear) {
  return std::pow(std::clamp(linear, 0.0f, 1.0f), 1.0f / 2.2f);
}

/// The share of pixels away from edges that differ by more than 8 of 255 as a display shows them.
double shareThatDiffers(const FloatImage& drawn, const FloatImage& expected) {
  int differing = 0, compared = 0;
  for (int y = 0; y < drawn.height(); ++y)
    for (int x = 0; x < drawn.width(); ++x) {
      if (nearEdge(expected, x, y)) continue;
      ++compared;
      differing += std::abs(displayed(drawn.at(x, y, 0)) - displayed(expected.at(x, y, 0))) > 8.0f / 255.0f;
    }
  EXPECT_GT(compared, drawn.width() * drawn.height() / 2);
  return differing / static_cast<double>(compared);
}

class Shadows : public GlTest {
 protected:
  FloatImage draw(const Node& scene, const Camera& camera) {
    const RenderTarget target(kPixelsAcross, kPixelsAcross, Precision::Float);
    const auto done = renderer.render(context(), scene, camera, target);
    EXPECT_TRUE(done) << (done ? "" : done.error().what);
    return target.read(context());
  }
  /// A white floor, seen from below a square of a material that keeps off light from above.
  FloatImage below(std::shared_ptr<const Material> material) {
    Node scene;
    scene.addChild(dressed(white()));
    scene.addChild(std::make_shared<Transform>(glm::translate(glm::dmat4(1.0), {0, 0, 3.0})))
        ->addChild(dressed(std::move(material)));
    auto light = std::make_shared<DirectionalLight>(glm::vec3(kPi));
    light->castsShadow = true;
    scene.addChild(light);
    return draw(scene, squareCamera());
  }
};

const Camera kCamera = Camera::lookAt({2.5f, 3.5f, 5.0f}, {0.2f, 0.4f, 0.0f});

void place(Node& scene, std::shared_ptr<Light> light, const glm::dmat4& to) {
  light->castsShadow = true;
  scene.addChild(std::make_shared<Transform>(to))->addChild(std::move(light));
}

/// Looks from a place at the origin, along -Z.
glm::dmat4 from(const glm::dvec3& eye) {
  return glm::inverse(glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0, 1, 0.1)));
}

TEST_F(Shadows, FallWhereRaysFindThem) {
  const Mesh mesh = ballOnFloor();
  const glm::vec3 lamp(-2.0f, 4.0f, 1.5f);
  const glm::vec3 candela(kPi * glm::dot(lamp, lamp)), lux(kPi);
  struct Case {
    const char* name;
    std::shared_ptr<Light> light;
    ReferenceLight reference;
  };
  const std::array cases{
      Case{"directional",
           std::make_shared<DirectionalLight>(lux),
           {ReferenceLight::Kind::Directional, glm::normalize(lamp), lux}},
      Case{"spot",
           std::make_shared<SpotLight>(candela, 0.99f, 1.0f),
           {ReferenceLight::Kind::Point, lamp, candela}},
      Case{"point", std::make_shared<PointLight>(candela), {ReferenceLight::Kind::Point, lamp, candela}},
      Case{"a spot of half of all directions",
           std::make_shared<SpotLight>(candela, 1.4f, 1.5f),
           {ReferenceLight::Kind::Point, lamp, candela}}};
  const ReferenceRenderer reference = valueOf(
      ReferenceRenderer::create({mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords, mesh.indices}));
  ReferenceShot shot;
  shot.eye = {2.5f, 3.5f, 5.0f};
  shot.target = {0.2f, 0.4f, 0.0f};
  shot.verticalFieldOfView = kCamera.verticalFieldOfView;
  shot.width = shot.height = kPixelsAcross;
  shot.samples = 1;
  ReferenceMaterial material;
  material.value = [](int, int, glm::vec3 light, glm::vec3) { return glm::vec3(light.z); };
  for (const Case& each : cases) {
    SCOPED_TRACE(each.name);
    Node scene;
    scene.addChild(dressed(white(), std::make_shared<const Mesh>(mesh)));
    place(scene, each.light, from(lamp));
    const FloatImage drawn = draw(scene, kCamera);
    EXPECT_EQ(renderer.statistics().shadowsLeftOut, 0u);
    shot.lights = {each.reference};
    const FloatImage traced = reference.render(shot, material);
    EXPECT_LE(shareThatDiffers(drawn, traced), 0.01);
    if (HasFailure()) {
      const auto folder = testFolder();
      (void)writeExr(folder / "drawn.exr", drawn);
      (void)writeExr(folder / "traced.exr", traced);
      ADD_FAILURE() << "pictures are kept in " << folder;
      return;
    }
  }
}

// What nothing shades shows no shadow, however low the light stands.
TEST_F(Shadows, SurfacesDoNotShadeThemselves) {
  Mesh mesh = moved(makePlane(), glm::scale(glm::mat4(1.0f), glm::vec3(3.0f)));
  for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
  for (const bool sphere : {false, true}) {
    if (sphere) mesh = makeSphere(128);
    Node scene;
    scene.addChild(dressed(white(), std::make_shared<const Mesh>(mesh)));
    const auto light = std::make_shared<DirectionalLight>(glm::vec3(kPi));
    const auto turn = std::make_shared<Transform>();
    scene.addChild(turn)->addChild(light);
    for (const float degrees : {10.5f, 25.0f, 50.0f, 89.0f}) {
      SCOPED_TRACE((sphere ? "sphere, " : "plane, ") + std::to_string(degrees));
      const double angle = glm::radians(degrees);
      turn->setMatrix(from({std::cos(angle) * 0.8, std::cos(angle) * 0.6, std::sin(angle)}));
      light->castsShadow = false;
      const FloatImage expected = draw(scene, Camera::lookAt({0, -1, 3}, {0, 0, 0}));
      light->castsShadow = true;
      const FloatImage drawn = draw(scene, Camera::lookAt({0, -1, 3}, {0, 0, 0}));
      float most = 0.0f;
      for (int y = 0; y < kPixelsAcross; ++y)
        for (int x = 0; x < kPixelsAcross; ++x)
          // A ball's own shadow begins where the light grazes it.
          if (!sphere || expected.at(x, y, 0) > std::sin(glm::radians(10.0f)))
            most = std::max(most, std::abs(drawn.at(x, y, 0) - expected.at(x, y, 0)));
      EXPECT_LT(most, 2e-3f);
    }
  }
}

TEST_F(Shadows, MapsAreDrawnAgainOnlyWhereSomethingChanged) {
  Node scene;
  const auto turn = std::make_shared<Transform>();
  scene.addChild(turn)->addChild(dressed(white()));
  place(scene, std::make_shared<DirectionalLight>(glm::vec3(1.0f)), from({1, 2, 3}));
  place(scene, std::make_shared<PointLight>(glm::vec3(1.0f)), from({0, 0, 3}));
  const auto drawnFor = [&](const Camera& camera) {
    draw(scene, camera);
    return renderer.statistics().shadowMapsDrawn;
  };
  EXPECT_EQ(drawnFor(squareCamera()), 7u);
  EXPECT_EQ(drawnFor(squareCamera()), 0u);
  EXPECT_EQ(drawnFor(kCamera), 0u);
  turn->setMatrix(glm::rotate(glm::dmat4(1.0), 0.2, {0, 1, 0}));
  EXPECT_GT(drawnFor(kCamera), 1u);
  EXPECT_EQ(drawnFor(kCamera), 0u);
}

// A picture whose left half is opaque, and its right half of this alpha.
std::shared_ptr<const Material> halfOf(AlphaMode mode, float alpha) {
  auto image = std::make_shared<FloatImage>(2, 1, std::vector<std::string>{"R", "G", "B", "A"});
  for (int x = 0; x < 2; ++x)
    for (int c = 0; c < 4; ++c) image->at(x, 0, c) = c == 3 && x == 1 ? alpha : 1.0f;
  PBROptions options;
  options.alphaMode = mode;
  options.doubleSided = true;
  options.baseColorTexture.image = std::make_shared<TextureChunk>(std::shared_ptr<const FloatImage>(image));
  return std::make_shared<PBRMaterial>(options);
}

TEST_F(Shadows, AlphaLetsLightThrough) {
  struct Case {
    AlphaMode mode;
    float alpha, through;
  };
  for (const Case& each : {Case{AlphaMode::Opaque, 0.0f, 0.0f}, Case{AlphaMode::Mask, 0.0f, 1.0f},
                           Case{AlphaMode::Mask, 0.8f, 0.0f}, Case{AlphaMode::Blend, 0.5f, 0.5f},
                           Case{AlphaMode::Blend, 0.0f, 1.0f}}) {
    SCOPED_TRACE(testing::Message() << "mode " << static_cast<int>(each.mode) << ", alpha " << each.alpha);
    const FloatImage drawn = below(halfOf(each.mode, each.alpha));
    EXPECT_NEAR(drawn.at(kPixelsAcross / 4, kPixelsAcross / 2, 0), 0.0f, 0.02f);
    EXPECT_NEAR(drawn.at(3 * kPixelsAcross / 4, kPixelsAcross / 2, 0), each.through, 0.02f);
  }
}

TEST_F(Shadows, GlassLetsLightThrough) {
  PBROptions glass{.baseColor = {1.0f, 0.8f, 0.6f, 1.0f}, .metallic = 0.0f, .transmission = {.factor = 0.6f}};
  const auto middle = [&] {
    return below(std::make_shared<PBRMaterial>(glass)).at(kPixelsAcross / 2, kPixelsAcross / 2, 0);
  };
  EXPECT_NEAR(middle(), 0.5f, 0.02f) << "0.6 times 0.8, in quarters";
  glass.metallic = 1.0f;
  EXPECT_NEAR(middle(), 0.0f, 0.02f);
}

TEST_F(Shadows, OfEightLightsAtMostAndTheRestIsTold) {
  Node scene;
  scene.addChild(dressed(white()));
  for (int i = 0; i < 10; ++i) place(scene, std::make_shared<SpotLight>(glm::vec3(1.0f)), from({0, 0, 3}));
  draw(scene, squareCamera());
  EXPECT_EQ(renderer.statistics().shadowMapsDrawn, 8u);
  EXPECT_EQ(renderer.statistics().shadowsLeftOut, 2u);
}

// The host's framebuffer, viewport, scissor and masks are as they were, and its scissor does not
// cut the map.
TEST_F(Shadows, AHostKeepsWhereItDraws) {
  Node scene;
  scene.addChild(dressed(white()));
  scene.addChild(std::make_shared<Transform>(glm::translate(glm::dmat4(1.0), {0, 0, 3.0})))
      ->addChild(dressed(white()));
  auto light = std::make_shared<DirectionalLight>(glm::vec3(kPi));
  light->castsShadow = true;
  scene.addChild(light);
  const RenderTarget target(kPixelsAcross, kPixelsAcross, Precision::Float);
  ASSERT_TRUE(target.prepare(context()));
  target.bindAndClear(context(), glm::vec4(0.0f));
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, kPixelsAcross / 2, kPixelsAcross);
  GLint before = 0, after = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  {
    const auto passive = valueOf(PassiveWindow::adopt());
    const auto done = passive->render(scene, squareCamera());
    EXPECT_TRUE(done) << (done ? "" : done.error().what);
    EXPECT_EQ(passive->statistics().shadowMapsDrawn, 1u);
  }
  std::array<GLint, 4> viewport{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &after);
  EXPECT_EQ(after, before);
  EXPECT_EQ(viewport[2], kPixelsAcross);
  EXPECT_TRUE(glIsEnabled(GL_SCISSOR_TEST));
  glDisable(GL_SCISSOR_TEST);
  RenderTarget::unbind();
  EXPECT_NEAR(target.read(context()).at(kPixelsAcross / 4, kPixelsAcross / 2, 0), 0.0f, 0.01f);
}

}  // namespace
}  // namespace weft::test
