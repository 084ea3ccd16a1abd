#include "weft/scene_io/FieldCache.h"

#include <gmock/gmock.h>

#include <chrono>
#include <filesystem>

#include "ConstantField.h"
#include "GlTest.h"
#include "GltfText.h"
#include "PatchMap.h"
#include "TestField.h"
#include "TestSupport.h"
#include "TextFile.h"
#include "weft/core/ImageComparison.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scene_io/SceneSetup.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/MaterialGroup.h"
#include "weft/scenegraph/Traversal.h"

namespace weft::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

fs::path writtenField() {
  const fs::path file = testFolder() / "cloth.rf.exr";
  requireDone(writeReflectanceField(testField(), file));
  return file;
}

std::shared_ptr<Node> lit(std::shared_ptr<const Material> material) {
  auto root = dressed(std::move(material));
  root->addChild(std::make_shared<DirectionalLight>(glm::vec3(3)));
  return root;
}

class FieldCacheTest : public GlTest {
 protected:
  /// The picture in a window of its own.
  Result<FloatImage> elsewhere(const Node& root) {
    auto image = inAnotherWindow(root);
    window->makeCurrent();
    return image;
  }

 private:
  static Result<FloatImage> inAnotherWindow(const Node& root) {
    const auto other = valueOf(HeadlessWindow::create(true));
    RenderAction action;
    const RenderTarget target(8, 8, Precision::Float);
    WEFT_TRY_VOID(action.render(other->context(), root, squareCamera(), target));
    return target.read(other->context());
  }
};

TEST(FieldCache, ReadsAFileOnceByWhateverNameAndWhileItIsUsed) {
  const fs::path file = writtenField();
  const fs::path link = file.parent_path() / "link.rf.exr";
  fs::create_symlink(file, link);
  FieldCache fields;
  auto first = valueOf(fields.load(file));
  EXPECT_EQ(valueOf(fields.load(link)), first);
  EXPECT_EQ(valueOf(fields.load(file.parent_path() / "." / file.filename())), first);
  const std::weak_ptr<const BTFTextures> gone = first;
  first.reset();
  EXPECT_TRUE(gone.expired());
  EXPECT_TRUE(fields.load(file));
}

TEST(FieldCache, AFileThatIsWrittenAnewIsReadAnew) {
  const fs::path file = writtenField();
  FieldCache fields;
  const auto first = valueOf(fields.load(file));
  writeConstantField(file, {1, 0, 0});
  const auto second = valueOf(fields.load(file));
  EXPECT_NE(second, first);
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(2));
  EXPECT_NE(valueOf(fields.load(file)), second);
}

TEST(FieldCache, TexturesThatArePreparedServeBoth) {
  const fs::path file = writtenField();
  FieldCache fields;
  const auto plain = valueOf(fields.load(file));
  const auto prepared = valueOf(fields.load(file, true));
  EXPECT_NE(plain, prepared);
  EXPECT_EQ(valueOf(fields.load(file)), prepared);
}

TEST(FieldCache, SaysWhatIsWrongWithAFile) {
  FieldCache fields;
  const fs::path missing = testFolder() / "missing.rf.exr";
  EXPECT_EQ(fields.load(missing).error().message(), missing.string() + ": no such file");
  const fs::path text = testFolder() / "text.rf.exr";
  writeText(text, "no field");
  EXPECT_THAT(fields.load(text).error().message(), HasSubstr("text.rf.exr"));
  const fs::path file = writtenField();
  FieldCache none{ModelRegistry()};
  EXPECT_THAT(none.load(file).error().message(), HasSubstr("unknown model 'rfp'"));
}

TEST_F(FieldCacheTest, ASecondContextReadsTheFileAgain) {
  const fs::path file = writtenField();
  FieldCache fields;
  const auto root = lit(valueOf(loadBTFMaterial(file, {}, fields)));
  const FloatImage here = picture(*root);
  EXPECT_LE(compareImages(picture(*root), here, 0.0f).failingShare, 0.0);
  EXPECT_LE(compareImages(valueOf(elsewhere(*root)), here, 0.0f).failingShare, 0.0);
  fs::remove(file);
  EXPECT_LE(compareImages(picture(*root), here, 0.0f).failingShare, 0.0);
  EXPECT_THAT(elsewhere(*root).error().message(), HasSubstr("cloth.rf.exr"));
}

TEST_F(FieldCacheTest, ASecondContextDoesNotShowAnotherFieldOfTheSameName) {
  const fs::path file = writtenField();
  const auto root = lit(valueOf(loadBTFMaterial(file)));
  (void)picture(*root);
  writeConstantField(file, {1, 0, 0});
  EXPECT_THAT(elsewhere(*root).error().message(), HasSubstr("has changed since it was loaded"));
}

TEST_F(FieldCacheTest, AFieldInMemoryIsDrawnInManyContextsAfterItIsGone) {
  const auto root = lit(valueOf(BTFMaterial::create(std::make_shared<const ReflectanceField>(testField()))));
  const FloatImage here = picture(*root);
  EXPECT_GT(here.at(1, 1, 0), 0.1f);
  EXPECT_LE(compareImages(valueOf(elsewhere(*root)), here, 0.0f).failingShare, 0.0);
}

// The textures of a scene's BTF materials.
std::vector<std::shared_ptr<const BTFTextures>> texturesIn(const GltfScene& scene) {
  std::vector<std::shared_ptr<const BTFTextures>> found;
  traverse(*scene.root, [&](const Node& node, const glm::dmat4&) {
    if (const auto* group = dynamic_cast<const MaterialGroup*>(&node.core()))
      if (const auto* btf = dynamic_cast<const BTFMaterial*>(group->material().get()))
        found.push_back(btf->textures());
    return Visit::Continue;
  });
  return found;
}

// Two materials of one field, in different scales.
fs::path sceneOfTwo() {
  const fs::path folder = writtenField().parent_path();
  const std::string extension = R"("extensions":{"WEFT_materials_btf":{"uri":"cloth.rf.exr","scale":)";
  std::string text =
      planeGltf(R"({"name":"a",)" + extension + R"([1,1]}}},{"name":"b",)" + extension + "[2,2]}}}");
  const std::string end = R"("material":0}]})";
  text.insert(text.find(end) + end.size() - 2,
              R"(,{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":1})");
  writeText(folder / "scene.gltf", text);
  return folder / "scene.gltf";
}

TEST(FieldCache, MaterialsOfOneFileShareTextures) {
  const auto textures = texturesIn(valueOf(loadGltf(sceneOfTwo())));
  ASSERT_EQ(textures.size(), 2u);
  EXPECT_EQ(textures[0], textures[1]);
}

TEST(FieldCache, ScenesShareWhatTheirOptionsName) {
  const fs::path file = sceneOfTwo();
  GltfOptions options;
  options.fields = std::make_shared<FieldCache>();
  const GltfScene first = valueOf(loadGltf(file, options));
  SceneOptions shape{.scene = "shape:plane",
                     .materialFiles = {{"*", (file.parent_path() / "cloth.rf.exr").string()}}};
  shape.fields = options.fields;
  const SceneSetup second = valueOf(SceneSetup::create(shape));
  ASSERT_EQ(texturesIn(second.scene()).size(), 1u);
  EXPECT_EQ(texturesIn(second.scene())[0], texturesIn(first)[0]);
}

TEST(FieldCache, MaterialsOfOneMapShareIt) {
  const fs::path field = writtenField(), map = field.parent_path() / "a.coords.exr";
  requireDone(writeCoordinateMap(map, patchMap({8, 6}, {2, 2}, 2)));
  FieldCache fields;
  const auto first = valueOf(loadBTFMaterial(field, {}, fields, map));
  EXPECT_EQ(first->map(), valueOf(loadBTFMaterial(field, {.exposure = 1.0f}, fields, map))->map());
  EXPECT_EQ(first->surfaceSize(), glm::ivec2(8, 6));

  requireDone(writeCoordinateMap(map, patchMap({8, 6}, {3, 2}, 2)));
  const auto wrong = loadBTFMaterial(field, {}, fields, map);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message(),
              HasSubstr("a.coords.exr: the coordinate map is for a sample of sample of 3 x 2 texels"));
  const auto missing = loadBTFMaterial(field, {}, fields, field.parent_path() / "none.coords.exr");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr("none.coords.exr: no such file"));
}

}  // namespace
}  // namespace weft::test
