#include <gmock/gmock.h>

#include <cstring>
#include <glm/ext/matrix_transform.hpp>

#include "GlTest.h"
#include "GltfText.h"
#include "TestField.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/ImageComparison.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

constexpr int kSize = 32;

class GltfRender : public test::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    folder = test::testFolder();
    test::requireDone(writeReflectanceField(test::testField(), folder / "test.rf.exr"));
  }

  /// As shown by a camera that looks at it from the side, under a lamp from the upper right.
  FloatImage picture(const std::shared_ptr<Node>& scene) {
    Node root;
    root.addChild(scene);
    root.addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1), glm::vec3(1, 2, 2))))
        ->addChild(std::make_shared<PointLight>(glm::vec3(20)));
    const RenderTarget target(kSize, kSize, Precision::Float);
    test::requireDone(
        renderer.render(context(), root, Camera::lookAt({0.4f, -0.8f, 1.4f}, {0, 0, 0}), target));
    return target.read(context());
  }

  FloatImage pictureOfFile(const std::string& gltf) {
    test::writeText(folder / "scene.gltf", gltf);
    return picture(test::valueOf(loadGltf(folder / "scene.gltf")).root);
  }

  FloatImage pictureOfPlane(glm::vec2 textureScale) {
    BTFMaterialOptions options;
    options.textureScale = textureScale;
    return picture(test::dressed(
        test::valueOf(BTFMaterial::create(std::make_shared<ReflectanceField>(test::testField()), options)),
        std::make_shared<Mesh>(makePlane())));
  }

  std::filesystem::path folder;
};

std::string btfMaterial(const std::string& more = "") {
  return R"({"name":"cloth","extensions":{"WEFT_materials_btf":{"uri":"test.rf.exr")" + more + "}}}";
}

TEST_F(GltfRender, ShowsAPlaneLikeTheBuiltInOne) {
  const FloatImage expected = pictureOfPlane({1, 1});
  ASSERT_GT(expected.at(kSize / 2, kSize / 2, 0), 0.05f) << "the plane is in the picture";
  EXPECT_EQ(compareImages(pictureOfFile(test::planeGltf(btfMaterial())), expected).maximum, 0.0f);
}

TEST_F(GltfRender, RepeatsTheMaterialAsTheExtensionSays) {
  const FloatImage picture = pictureOfFile(test::planeGltf(btfMaterial(R"(,"scale":[3,2])")));
  EXPECT_EQ(compareImages(picture, pictureOfPlane({3, 2})).maximum, 0.0f);
  EXPECT_GT(compareImages(picture, pictureOfPlane({1, 1})).maximum, 0.1f);
}

TEST_F(GltfRender, SamplesTexturesAsTheirSamplerSays) {
  // Black and white halves of 2 x 2 texels, left and right, seen over u, v = -0.5..1.5.
  Image halves(2, 2, 3);
  for (int y = 0; y < 2; ++y)
    for (int channel = 0; channel < 3; ++channel) halves.pixel(1, y)[channel] = 255;
  test::requireDone(writePng(folder / "halves.png", halves));
  const auto valuesAlongU = [&](const std::string& sampler) {
    test::writeText(
        folder / "scene.gltf",
        test::planeGltf(
            R"({"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorTexture":)"
            R"({"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2],"offset":[-0.5,-0.5]}}}}}],)"
            R"("textures":[{"source":0,"sampler":0}],"images":[{"uri":"halves.png"}],"samplers":[)" +
            sampler));
    const GltfScene scene = test::valueOf(loadGltf(folder / "scene.gltf"));
    Camera camera = test::squareCamera();
    camera.verticalFieldOfView = 2.0f * std::atan(0.25f);
    const RenderTarget target(kSize, kSize, Precision::Float);
    test::requireDone(renderer.render(context(), *scene.root, camera, target));
    const FloatImage image = target.read(context());
    // At u = -0.375, 0.125, 0.4, 0.875, 1.375.
    std::vector<float> values;
    for (const int x : {2, 10, 14, 22, 29}) values.push_back(image.at(x, 3, 0));
    return values;
  };
  using testing::ElementsAre;
  const auto grey = testing::AllOf(testing::Gt(0.1f), testing::Lt(0.5f));
  EXPECT_THAT(valuesAlongU(R"({"magFilter":9728})"), ElementsAre(1, 0, 0, 1, 0));
  EXPECT_THAT(valuesAlongU(R"({"magFilter":9728,"wrapS":33071})"), ElementsAre(0, 0, 0, 1, 1));
  EXPECT_THAT(valuesAlongU(R"({"magFilter":9728,"wrapS":33648})"), ElementsAre(0, 0, 0, 1, 1));
  EXPECT_THAT(valuesAlongU(R"({"magFilter":9728,"wrapT":33071})"), ElementsAre(1, 0, 0, 1, 0));
  EXPECT_THAT(valuesAlongU(R"({"magFilter":9729,"wrapS":33071})"), ElementsAre(0, 0, grey, 1, 1));
}

// A lean of less than half a step of 8 bits; the lamp stands on the side to which it leans.
TEST_F(GltfRender, NormalsHaveSixteenBits) {
  const auto middle = [&](int lean) {
    test::writeBytes(folder / "normals.png", test::widePng(2, 2, [&](int, int, int c) {
                       return c == 2 ? 65535 : 32768 + (c == 0 ? lean : 0);
                     }));
    const FloatImage image = pictureOfFile(
        test::planeGltf(R"({"normalTexture":{"index":0},"pbrMetallicRoughness":{"metallicFactor":0}}],)"
                        R"("textures":[{"source":0}],"images":[{"uri":"normals.png"})"));
    return image.at(kSize / 2, kSize / 2, 0);
  };
  const float flat = middle(0);
  EXPECT_GT(middle(120), 1.0005f * flat);
  EXPECT_LT(middle(120), 1.005f * flat);
}

// What bytes mean, the use says: widePng() claims a gamma of 1.
TEST_F(GltfRender, ColoursAreSrgbWhateverThePngSays) {
  const auto picture = [&](const char* file) {
    return pictureOfFile(test::planeGltf(
        R"({"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
        R"("textures":[{"source":0}],"images":[{"uri":")" +
        std::string(file) + R"("})"));
  };
  const auto value = [](int x, int y, int c) { return 60 + 30 * c + 20 * x + 10 * y; };
  test::requireDone(writePng(folder / "narrow.png", test::imageOf(2, 2, value)));
  test::writeBytes(folder / "wide.png",
                   test::widePng(2, 2, [&](int x, int y, int c) { return 257 * value(x, y, c) + 60; }));
  const FloatImage narrow = picture("narrow.png");
  ASSERT_GT(narrow.at(kSize / 2, kSize / 2, 0), 0.04f);
  EXPECT_EQ(compareImages(picture("wide.png"), narrow).maximum, 0.0f);
}

TEST_F(GltfRender, ShowsTheSameThroughANodeThatMirrorsAMirroredMesh) {
  // x mirrored in the positions, and back again by the node: the winding turns twice, the image
  // stays.
  std::vector<std::uint8_t> bytes = test::planeBuffer().bytes();
  // the sign of x
  for (std::size_t vertex = 0; vertex < 4; ++vertex) bytes[vertex * 12 + 3] ^= 0x80;
  const std::vector<std::uint16_t> indices{0, 3, 2, 0, 1, 3};
  std::memcpy(bytes.data() + 128, indices.data(), 12);
  test::BufferBytes buffer;
  buffer.add(bytes);
  const std::string gltf = test::replaced(test::planeGltf(btfMaterial(), buffer.dataUri()),
                                          R"({"mesh":0,"name":"plane"})", R"({"mesh":0,"scale":[-1,1,1]})");
  EXPECT_LT(compareImages(pictureOfFile(gltf), pictureOfPlane({1, 1})).maximum, 1e-5f);
}

TEST_F(GltfRender, LightsAndPlacesAsTheFileSays) {
  // The same plane, 2 units to the right, with the file's own lamp and camera there.
  const std::string gltf = test::replaced(
      test::replaced(
          test::planeGltf(btfMaterial()), R"({"asset")",
          R"({"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":20}]}},)"
          R"("cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.01,"zfar":100}}],)"
          R"("asset")"),
      R"("nodes":[{"mesh":0,"name":"plane"}])",
      R"("nodes":[{"translation":[2,0,0],"children":[1,2,3]},{"mesh":0},)"
      R"({"translation":[1,2,2],"extensions":{"KHR_lights_punctual":{"light":0}}},)"
      R"({"translation":[0,0,2],"camera":0}])");
  test::writeText(folder / "scene.gltf", gltf);
  const GltfScene scene = test::valueOf(loadGltf(folder / "scene.gltf"));
  const RenderTarget target(kSize, kSize, Precision::Float);
  test::requireDone(renderer.render(context(), *scene.root, scene.cameras.at(0).camera, target));
  const FloatImage actual = target.read(context());

  Node root;
  root.addChild(
      test::dressed(test::valueOf(BTFMaterial::create(std::make_shared<ReflectanceField>(test::testField()))),
                    std::make_shared<Mesh>(makePlane())));
  root.addChild(std::make_shared<Transform>(glm::translate(glm::mat4(1), glm::vec3(1, 2, 2))))
      ->addChild(std::make_shared<PointLight>(glm::vec3(20)));
  test::requireDone(renderer.render(context(), root, Camera::lookAt({0, 0, 2}, {0, 0, 0}), target));
  EXPECT_LT(compareImages(actual, target.read(context())).maximum, 1e-5f);
}

TEST_F(GltfRender, ShowsAnOrthographicCamerasViewFromAFarAway) {
  // What a narrow perspective view from far away comes close to, highlights included.
  const auto pictureOf = [&](const std::string& camera, const std::string& z) {
    const std::string material = R"({"pbrMetallicRoughness":{"roughnessFactor":0.4}})";
    test::writeText(
        folder / "scene.gltf",
        test::replaced(
            test::replaced(
                test::planeGltf(material), R"({"asset")",
                R"({"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":20}]}},"cameras":[)" +
                    camera + R"(],"asset")"),
            R"("nodes":[{"mesh":0,"name":"plane"}])",
            R"("nodes":[{"children":[1,2,3]},{"mesh":0,"rotation":[0.2588190451,0,0,0.9659258263]},)"
            R"({"translation":[0.5,1,2],"extensions":{"KHR_lights_punctual":{"light":0}}},)"
            R"({"translation":[0,0,)" +
                z + R"(],"camera":0}])"));
    const GltfScene scene = test::valueOf(loadGltf(folder / "scene.gltf"));
    const RenderTarget target(kSize, kSize, Precision::Float);
    test::requireDone(renderer.render(context(), *scene.root, scene.cameras.at(0).camera, target));
    return target.read(context());
  };
  const FloatImage orthographic =
      pictureOf(R"({"type":"orthographic","orthographic":{"xmag":0.6,"ymag":0.6,"znear":0,"zfar":10}})", "5");
  const FloatImage perspective =
      pictureOf(R"({"type":"perspective","perspective":{"yfov":0.0012,"znear":990,"zfar":1010}})", "1000");
  const FloatImage near =
      pictureOf(R"({"type":"perspective","perspective":{"yfov":0.58,"znear":1,"zfar":10}})", "2");
  EXPECT_LT(compareImages(orthographic, perspective, 2e-2f).failingShare, 0.02);
  EXPECT_GT(compareImages(orthographic, near, 2e-2f).failingShare, 0.1);
}

}  // namespace
}  // namespace weft
