// What weft-render makes of its command line, before anything is drawn.
#include "weft/scene_io/SceneSetup.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/ext/matrix_transform.hpp>

#include "ConstantField.h"
#include "GltfText.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scene_io/MaterialSurface.h"
#include "weft/scenegraph/Geometry.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::valueOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Bounds boundsOfPlane(const std::map<std::string, std::string>& materials) {
  return valueOf(SceneSetup::create({.scene = "shape:plane", .materialFiles = materials})).scene().bounds;
}

TEST(SceneSetup, APlaneHasTheAspectOfItsMeasurement) {
  const fs::path field = test::testFolder() / "field.rf.exr";
  for (const glm::ivec2 size : {glm::ivec2(4, 2), glm::ivec2(3, 6), glm::ivec2(5, 5)}) {
    test::writeConstantField(field, glm::vec3(1), size.x, size.y);
    const Bounds plane = boundsOfPlane({{"*", field.string()}});
    const glm::vec2 half = 0.5f * glm::vec2(size) / static_cast<float>(std::max(size.x, size.y));
    EXPECT_EQ(plane.maximum, glm::dvec3(half, 0));
    EXPECT_EQ(plane.minimum, -plane.maximum);
  }
  EXPECT_EQ(boundsOfPlane({}).maximum, glm::dvec3(0.5, 0.5, 0));
}

std::vector<SceneOptions::Lamp> lampsOf(const SceneOptions& options) {
  return valueOf(SceneSetup::create(options)).lamps();
}

TEST(SceneSetup, AStudioLightsWhatHasNoLight) {
  SceneOptions options{.scene = "shape:sphere", .viewpoint = {{{5, 0, 0}, {0, 0, 0}}}};
  const auto studio = lampsOf(options);
  ASSERT_EQ(studio.size(), 3u);
  // The camera looks along -X: its left is +Z.
  const glm::dvec3 key = studio[0].place, fill = studio[1].place, rim = studio[2].place;
  EXPECT_TRUE(key.z > 1 && key.y > 1 && key.x > 1) << "above left, on the camera's side";
  EXPECT_TRUE(fill.z < -1 && fill.x > 1) << "to its right";
  EXPECT_TRUE(rim.x < -1 && rim.y > 1) << "behind";
  EXPECT_GT(studio[0].color.g, studio[1].color.g + studio[2].color.g);

  options.defaultLight = SceneOptions::DefaultLight::Lamp;
  EXPECT_EQ(lampsOf(options).size(), 1u);
  options.lamps = {{{1, 2, 3}, glm::vec3(1)}};
  EXPECT_EQ(lampsOf(options).size(), 1u);
  options.studio = true;
  EXPECT_EQ(lampsOf(options).size(), 4u);
  EXPECT_TRUE(lampsOf({.scene = "shape:sphere", .environment = "sky"}).empty());
}

TEST(SceneSetup, AFilesOwnLightsAreItsLights) {
  const fs::path file = test::testFolder() / "lit.gltf";
  std::string scene = test::replaced(test::planeGltf(), R"({"mesh":0,)",
                                     R"({"extensions":{"KHR_lights_punctual":{"light":0}},"mesh":0,)");
  scene.insert(1, R"("extensionsUsed":["KHR_lights_punctual"],)"
                  R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"}]}},)");
  std::ofstream(file) << scene;
  EXPECT_EQ(lampsOf({.scene = file.string()}).size(), 0u);
  EXPECT_EQ(lampsOf({.scene = file.string(), .studio = true}).size(), 3u);
}

// The plane is a square of side 1, seen from in front: the picture is as high as the distance says.
TEST(SceneSetup, WarnsWhereASampleRepeatsTooSeldomOrTooOften) {
  const fs::path field = test::testFolder() / "field.rf.exr";
  const auto warningsOf = [&](float scale, double distance) {
    SceneOptions options{.scene = "shape:plane",
                         .materialFiles = {{"*", field.string()}},
                         .btf = {.textureScale = glm::vec2(scale)},
                         .viewpoint = {{{0, 0, distance}, {0, 0, 0}}},
                         .aspect = 1.0f};
    return valueOf(SceneSetup::create(options)).warnings();
  };
  const std::vector<glm::vec3> someViews{directionFromDegrees(60, 0), directionFromDegrees(60, 120),
                                         directionFromDegrees(60, 240)};
  test::writeConstantField(field, glm::vec3(1), 4, 4, someViews);
  EXPECT_THAT(warningsOf(1.0f, 5), ElementsAre(HasSubstr("seen once each way, so large that it may look "
                                                         "plain; --uv-scale 20 shows it 20 times")));
  EXPECT_THAT(warningsOf(2.01f, 5), IsEmpty());
  EXPECT_THAT(warningsOf(199.0f, 5), IsEmpty());
  EXPECT_THAT(warningsOf(201.0f, 5),
              ElementsAre(HasSubstr("seen 201 times each way, so small that it may blur")));
  // From 0.5 in front of it, 2 x 0.5 x tan(0.35) of it are seen.
  EXPECT_THAT(warningsOf(10.0f, 0.5), IsEmpty());
  EXPECT_THAT(warningsOf(4.0f, 0.5), ElementsAre(HasSubstr("seen 1.5 times each way")));
  test::writeConstantField(field, glm::vec3(1), 4, 4);
  EXPECT_THAT(warningsOf(1.0f, 5), IsEmpty()) << "one view is a picture, which is shown once";
}

TEST(MaterialSurface, SaysHowLargeTextureCoordinatesAre) {
  const auto material = std::make_shared<LambertMaterial>();
  Node root(std::make_shared<MaterialGroup>(material));
  Mesh plane = makePlane();  // 1 x 1
  for (glm::vec2& uv : plane.texcoords) uv = uv * glm::vec2(3, 2) - glm::vec2(1, 0);
  root.addChild(std::make_shared<Transform>(glm::scale(glm::dmat4(1.0), glm::dvec3(2.0))))
      ->addChild(std::make_shared<Geometry>(std::make_shared<Mesh>(plane)));
  const std::vector<MaterialSurface> surfaces = surfacesOf(root);
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].material, material);
  EXPECT_EQ(surfaces[0].triangles, 2u);
  EXPECT_NEAR(surfaces[0].area, 4.0, 1e-9);
  EXPECT_NEAR(surfaces[0].textureArea, 6.0, 1e-6);
  EXPECT_NEAR(surfaces[0].unitLength(), std::sqrt(4.0 / 6.0), 1e-6);
  EXPECT_EQ(surfaces[0].minimum, glm::dvec2(-1, 0));
  EXPECT_EQ(surfaces[0].maximum, glm::dvec2(2, 2));
  // The picture's left half shows half of it, and what is behind the eye is not seen.
  const glm::dmat4 leftHalf = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_NEAR(surfacesOf(root, leftHalf)[0].textureArea, 3.0, 1e-6);
  const Camera away = Camera::lookAt({0, 0, 5}, {0, 0, 9});
  EXPECT_EQ(surfacesOf(root, away.projection(1.0f) * away.view)[0].textureArea, 0.0);
}

}  // namespace
}  // namespace weft
