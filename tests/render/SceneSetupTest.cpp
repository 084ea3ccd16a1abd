// What weft-render makes of its command line, before anything is drawn.
#include "weft/scene_io/SceneSetup.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ConstantField.h"
#include "GltfText.h"
#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::valueOf;

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

}  // namespace
}  // namespace weft
