// What weft-render makes of its command line, before anything is drawn.
#include "weft/scene_io/SceneSetup.h"

#include <gtest/gtest.h>

#include "ConstantField.h"
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

}  // namespace
}  // namespace weft
