#include <glm/ext/matrix_transform.hpp>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/materials/ChunkMaterial.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/LOD.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

/// Where a scene stands, and how large it is.
struct World {
  glm::dvec3 origin{0.0};
  double scale = 1.0;

  glm::dvec3 place(const glm::dvec3& p) const { return origin + scale * p; }
};

void PrintTo(const World& world, std::ostream* out) {
  *out << "scale " << world.scale << " at " << world.origin.x << ", " << world.origin.y << ", "
       << world.origin.z;
}

std::shared_ptr<Transform> placedAt(const glm::dvec3& by, double scale = 1.0) {
  return std::make_shared<Transform>(glm::scale(glm::translate(glm::dmat4(1.0), by), glm::dvec3(scale)));
}

/// A ball and a mirrored square, shiny, under every kind of light.
std::shared_ptr<Node> shinyScene(const World& world) {
  auto root = std::make_shared<Node>(placedAt(world.origin, world.scale));
  const auto shiny = std::make_shared<PBRMaterial>(
      PBROptions{.baseColor = {0.8f, 0.5f, 0.2f, 1.0f}, .metallic = 0.3f, .roughness = 0.3f});
  root->addChild(placedAt({-0.3, 0.1, 0.4}, 0.5))
      ->addChild(test::dressed(shiny, std::make_shared<Mesh>(makeSphere(16))));
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(0.6, 1.0, 0.1));
  root->addChild(std::make_shared<Transform>(glm::scale(turned, glm::dvec3(-0.9, 0.8, 1.0))))
      ->addChild(test::dressed(shiny));

  const auto area = static_cast<float>(world.scale * world.scale);
  const auto point = std::make_shared<PointLight>(area * glm::vec3(3.0f, 2.0f, 1.0f));
  point->range = static_cast<float>(7.0 * world.scale);
  root->addChild(placedAt({1.0, 1.5, 2.0}))->addChild(point);
  root->addChild(placedAt({-0.5, 0.3, 3.0}))
      ->addChild(std::make_shared<SpotLight>(area * glm::vec3(2.0f, 4.0f, 6.0f), 0.05f, 0.4f));
  root->addChild(std::make_shared<Transform>(glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1, 1, 0))))
      ->addChild(std::make_shared<DirectionalLight>(glm::vec3(0.5f)));
  return root;
}

Camera cameraIn(const World& world, bool orthographic) {
  Camera camera = Camera::lookAt(world.place({0.4, 0.3, 2.5}), world.place({0.1, 0.0, 0.2}));
  camera.orthographicHeight = orthographic ? static_cast<float>(2.0 * world.scale) : 0.0f;
  camera.nearPlane = static_cast<float>(0.5 * world.scale);
  camera.farPlane = static_cast<float>(5.0 * world.scale);
  return camera;
}

const World kFarAndLarge[] = {{{6.4e6, 2133333.3333333335, -6.4e6}, 1.0},
                              {{1e8, -1e8, 1e8}, 1.0},
                              {{1e12, 0.0, -3e11}, 100.0},
                              {{0.0, 0.0, 0.0}, 1e9},
                              {{1e9, 2e9, -1e9}, 1e9},
                              {{0.0, 0.0, 0.0}, 1e13},
                              {{0.0, 0.0, 0.0}, 1e-6},
                              {{5.0, 0.0, 1.0}, 1e-6},
                              {{0.0, 0.0, 0.0}, 1e-13}};

class ScaleTest : public test::GlTest {
 protected:
  FloatImage drawn(const Node& root, const Camera& camera) {
    const RenderTarget target(48, 48, Precision::Float);
    test::requireDone(renderer.render(context(), root, camera, target));
    return target.read(context());
  }
};

/// Of the values of two pictures of which the first shows something, the share that differs.
double differing(const FloatImage& actual, const FloatImage& expected) {
  EXPECT_EQ(actual.values().size(), expected.values().size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < expected.values().size(); ++i)
    different +=
        !(std::abs(actual.values()[i] - expected.values()[i]) <= 2e-3f * (1.0f + expected.values()[i]));
  return static_cast<double>(different) / static_cast<double>(expected.values().size());
}

TEST_F(ScaleTest, ASceneLooksTheSameAnywhereAndOfAnySize) {
  for (const bool orthographic : {false, true}) {
    const FloatImage expected = drawn(*shinyScene({}), cameraIn({}, orthographic));
    EXPECT_GT(differing(drawn(Node(), cameraIn({}, orthographic)), expected), 0.3) << "it shows something";
    for (const World& world : kFarAndLarge)
      // At silhouettes a sample can fall to the other side.
      EXPECT_LT(differing(drawn(*shinyScene(world), cameraIn(world, orthographic)), expected), 2e-3)
          << testing::PrintToString(world);
  }
}

TEST_F(ScaleTest, VerticesMayBeFarFromTheirOwnOrigin) {
  const glm::vec3 far(4194304.0f, -2097152.0f, 1048576.0f);  // halves are floats there
  const auto mesh = test::square();
  for (glm::vec3& position : mesh->positions) position += far;
  auto lit = std::make_shared<Node>(std::make_shared<DirectionalLight>(glm::vec3(3.0f)));
  const auto material = std::make_shared<LambertMaterial>();
  lit->addChild(test::dressed(material));
  auto farLit = std::make_shared<Node>(std::make_shared<DirectionalLight>(glm::vec3(3.0f)));
  farLit->addChild(test::dressed(material, mesh));
  EXPECT_EQ(differing(drawn(*farLit, cameraIn({far}, false)), drawn(*lit, cameraIn({}, false))), 0.0);
  auto back = std::make_shared<Node>(placedAt(-glm::dvec3(far)));
  back->addChild(farLit);
  EXPECT_EQ(differing(drawn(*back, cameraIn({}, false)), drawn(*lit, cameraIn({}, false))), 0.0);
}

/// Squares side by side, the middle one at the world's place, and after it one that is only seen
/// from nearby.
std::shared_ptr<Node> rowOfSquares(const World& world) {
  auto root = std::make_shared<Node>(placedAt(world.origin, world.scale));
  const auto material = std::make_shared<LambertMaterial>();
  for (int i = -20; i <= 20; ++i)
    root->addChild(placedAt({2.0 * i, 0, 0}))->addChild(test::dressed(material));
  const auto levels = std::make_shared<LOD>(std::vector<float>{static_cast<float>(2.6 * world.scale)});
  root->addChild(levels)->addChild(test::dressed(material));
  return root;
}

TEST_F(ScaleTest, WhatIsOutsideOrAtAnotherLevelIsNotDrawnAnywhere) {
  for (const World& world : kFarAndLarge) {
    SCOPED_TRACE(testing::PrintToString(world));
    const auto root = rowOfSquares(world);
    Camera camera = cameraIn(world, false);
    drawn(*root, camera);
    EXPECT_EQ(renderer.statistics().objects, 42u);
    EXPECT_EQ(renderer.statistics().culled,
              42u - 2u - 1u);               // two squares, and the one for eyes that are near
    camera.view[3].z -= 0.2 * world.scale;  // sees one more from farther away
    drawn(*root, camera);
    EXPECT_EQ(renderer.statistics().culled, 42u - 3u);
  }
}

TEST_F(ScaleTest, ShadersOfTheApplicationsFindPlacesInTheWorld) {
  const std::filesystem::path folder = test::testFolder();
  test::writeText(folder / "place.frag",
                  "#version 450 core\n#include \"lights.glsl\"\nin vec3 position;\nout vec4 color;\n"
                  "void main() { color = vec4(position + origin.xyz, dot(position, position)); }\n");
  const auto material = std::make_shared<ChunkMaterial>();
  material->setChunk(ProgramSlot,
                     std::make_shared<ProgramChunk>(ShaderSource{"mesh.vert", "place.frag", {}, {}, folder}));
  auto root = std::make_shared<Node>(placedAt({10, 20, 30}));
  root->addChild(test::dressed(material));
  Camera camera = test::squareCamera();
  camera.view = glm::translate(camera.view, glm::dvec3(-10, -20, -30));
  const FloatImage image = drawn(*root, camera);
  for (const int pixel : {0, 20, 47}) {
    const float x = (static_cast<float>(pixel) + 0.5f) / 24.0f - 1.0f;
    EXPECT_NEAR(image.at(pixel, 10, 0), 10.0f + x, 1e-4f);
    EXPECT_NEAR(image.at(pixel, 10, 1), 20.0f + 1.0f - 10.5f / 24.0f, 1e-4f);
    EXPECT_NEAR(image.at(pixel, 10, 2), 30.0f, 1e-4f);
    EXPECT_GT(image.at(pixel, 10, 3), 3.9f) << "from the eye";
  }
}

}  // namespace
}  // namespace weft
