// Materials in the terms of Khronos' extensions.

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "GlTest.h"
#include "GltfScenes.h"
#include "weft/core/ImageComparison.h"
#include "weft/io/ImageFile.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Light.h"

namespace weft {
namespace {

using test::drawnIn;
using test::Json;
using test::valueOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A square that fills the picture, under a sun from the front, whose texture is two texels wide.
class GltfMaterialsTest : public test::GlTest {
 protected:
  static constexpr const char* kLight =
      R"({"KHR_lights_punctual":{"lights":[{"type":"directional","intensity":3}]}})";

  void SetUp() override {
    GlTest::SetUp();
    folder = test::testFolder();
    test::GltfText text;
    text.add<float>({-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0}, "VEC3");
    text.add<float>({0, 1, 1, 1, 0, 0, 1, 0}, "VEC2");
    text.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    text.add<std::uint8_t>({0, 1, 2, 1, 3, 2}, "SCALAR");
    file = test::triangleGltf(text);
    file["meshes"][0]["primitives"][0] =
        Json::parse(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1,"NORMAL":2},"indices":3,"material":0})");
    file["textures"] = Json::parse(R"([{"source":0,"sampler":0}])");
    file["samplers"] = Json::parse(R"([{"magFilter":9728,"minFilter":9728}])");
    file["images"] = Json::parse(R"([{"uri":"a.png"}])");
    file["extensions"] = Json::parse(kLight);
    file["nodes"][0]["extensions"] = Json::parse(R"({"KHR_lights_punctual":{"light":0}})");
  }

  /// A picture whose left and right half have these texels.
  void writeTexture(const std::vector<std::uint8_t>& left, const std::vector<std::uint8_t>& right) {
    Image image(2, 1, static_cast<int>(left.size()));
    std::copy(left.begin(), left.end(), image.pixel(0, 0));
    std::copy(right.begin(), right.end(), image.pixel(1, 0));
    test::requireDone(writePng(folder / "a.png", image));
  }

  GltfScene loaded(const std::string& material) {
    file["materials"] = Json::array({Json::parse(material)});
    test::writeText(folder / "scene.gltf", file.dump());
    return valueOf(loadGltf(folder / "scene.gltf"));
  }

  FloatImage pictureOf(const std::string& material) {
    const GltfScene scene = loaded(material);
    EXPECT_THAT(scene.warnings, IsEmpty());
    return picture(*scene.root, 16, 16);
  }

  static PBROptions optionsOf(const GltfScene& scene) {
    return dynamic_cast<const PBRMaterial&>(*drawnIn(scene).at(0).material).options();
  }

  std::filesystem::path folder;
  Json file;
};

std::string specularGlossiness(const std::string& members) {
  return R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + members + "}}}";
}

// ---- KHR_materials_pbrSpecularGlossiness
// ------------------------------------------------------------------

/// What the extension says a colour is, of light from the eye: diffuse and GGX with the F0 that it
/// names.
glm::vec3 expectedFromTheFront(glm::vec3 diffuse, glm::vec3 specular, float glossiness) {
  const float alpha = (1 - glossiness) * (1 - glossiness);
  const float pi = 3.14159265f;
  // D V at n.h = n.l = n.v = 1: 1 / (pi alpha^2) / 4.
  const float highlight = 1.0f / (4.0f * pi * alpha * alpha);
  const float entering = 1.0f - std::max({specular.x, specular.y, specular.z});
  return 3.0f * (entering * diffuse / pi + specular * highlight);
}

TEST_F(GltfMaterialsTest, SpecularGlossinessIsShownAsItSays) {
  const FloatImage image = pictureOf(specularGlossiness(
      R"("diffuseFactor":[0.5,0.25,0.125,1],"specularFactor":[0.1,0.3,0.2],"glossinessFactor":0.2)"));
  const glm::vec3 expected =
      expectedFromTheFront(glm::vec3(0.5f, 0.25f, 0.125f), glm::vec3(0.1f, 0.3f, 0.2f), 0.2f);
  // Pixels beside the middle, seen and lit from nearly the front.
  for (int channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(image.at(7, 7, channel), expected[channel], 0.01f) << channel;
}

TEST_F(GltfMaterialsTest, SpecularGlossinessTexturesAreConvertedTexelByTexel) {
  writeTexture({188, 90, 40, 255}, {20, 188, 90, 51});  // sRGB and a glossiness of 1 and 0.2
  const FloatImage image = pictureOf(specularGlossiness(
      R"("diffuseFactor":[0.5,0.5,0.5,1],"glossinessFactor":0.75,"specularGlossinessTexture":{"index":0})"));
  const auto half = [&](const std::string& specular, const std::string& glossiness) {
    return pictureOf(specularGlossiness(R"("diffuseFactor":[0.5,0.5,0.5,1],"specularFactor":)" + specular +
                                        R"(,"glossinessFactor":)" + glossiness));
  };
  // The linear values of 188, 90, 40, 20.
  const FloatImage left = half("[0.5028865,0.1022417,0.0212190]", "0.75");
  const FloatImage right = half("[0.0069954,0.5028865,0.1022417]", "0.15");
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      // Between the middles of the two texels they are mixed; roughnesses have 8 bits.
      for (int channel = 0; (x < 4 || x > 11) && channel < 3; ++channel)
        EXPECT_NEAR(image.at(x, y, channel), (x < 8 ? left : right).at(x, y, channel),
                    0.02f + 0.02f * image.at(x, y, channel))
            << x << ' ' << y << ' ' << channel;
}

TEST_F(GltfMaterialsTest, SpecularGlossinessNeedsNoMembersNorAlpha) {
  const PBROptions plain = optionsOf(loaded(specularGlossiness("")));
  EXPECT_EQ(plain.baseColor, glm::vec4(1));
  EXPECT_EQ(plain.specularColor, glm::vec3(1));
  EXPECT_EQ(plain.roughness, 0.0f);
  EXPECT_EQ(plain.metallic, 0.0f);

  writeTexture({9, 9, 9}, {99, 99, 99});
  const GltfScene scene =
      loaded(specularGlossiness(R"("glossinessFactor":0.25,"specularGlossinessTexture":{"index":0})"));
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_FALSE(optionsOf(scene).metallicRoughnessTexture.image) << "all is as glossy as the factor says";
  EXPECT_EQ(optionsOf(scene).roughness, 0.75f);
}

TEST_F(GltfMaterialsTest, SpecularGlossinessTakesThePlaceOfTheFallback) {
  writeTexture({255, 0, 0}, {255, 0, 0});
  const PBROptions read = optionsOf(loaded(
      R"({"alphaMode":"MASK","pbrMetallicRoughness":{"metallicFactor":0.5,"metallicRoughnessTexture":{"index":0}},)"
      R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0}}}})"));
  EXPECT_EQ(read.metallic, 0.0f);
  EXPECT_FALSE(read.metallicRoughnessTexture.image);
  EXPECT_TRUE(read.baseColorTexture.image);
  EXPECT_EQ(read.alphaMode, AlphaMode::Mask);
}

TEST_F(GltfMaterialsTest, SpecularGlossinessWithoutItsImageIsMatt) {
  std::filesystem::remove(folder / "a.png");
  const GltfScene scene = loaded(specularGlossiness(R"("specularGlossinessTexture":{"index":0})"));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("specular-glossiness texture")));
  EXPECT_EQ(optionsOf(scene).refractiveIndex, 1.5f);
  EXPECT_EQ(optionsOf(scene).roughness, 1.0f);
}

TEST_F(GltfMaterialsTest, ConversionsOfOneImageForManyFactorsAreBounded) {
  test::requireDone(writePng(folder / "a.png", Image(4096, 2048, 4)));
  file["images"][0] = {{"uri", "a.png"}};
  Json materials = Json::array();
  for (int i = 0; i < 16; ++i) {
    materials.push_back(Json::parse(specularGlossiness(
        R"("specularGlossinessTexture":{"index":0},"glossinessFactor":)" + std::to_string(i / 16.0))));
    file["meshes"][0]["primitives"][i] = file["meshes"][0]["primitives"][0];
    file["meshes"][0]["primitives"][i]["material"] = i;
  }
  file["materials"] = materials;
  test::writeText(folder / "scene.gltf", file.dump());
  EXPECT_THAT(valueOf(loadGltf(folder / "scene.gltf")).warnings,
              testing::Contains(HasSubstr("too much memory for a file of this size")));
}

// ---- KHR_materials_specular
// -------------------------------------------------------------------------------

TEST_F(GltfMaterialsTest, TexturesOfSpecularMultiplyItsFactors) {
  writeTexture({188, 90, 255, 255}, {90, 188, 20, 102});
  const auto dielectric = [](const std::string& specular) {
    return R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5,"baseColorFactor":[0.2,0.2,0.2,1]},)"
           R"("extensions":{"KHR_materials_ior":{"ior":2.5},"KHR_materials_specular":{)" +
           specular + "}}}";
  };
  const FloatImage textured = pictureOf(
      dielectric(R"("specularFactor":0.5,"specularColorFactor":[2,2,2],"specularTexture":{"index":0},)"
                 R"("specularColorTexture":{"index":0})"));
  const FloatImage left =
      pictureOf(dielectric(R"("specularFactor":0.5,"specularColorFactor":[1.005773,0.2044834,2])"));
  const FloatImage right =
      pictureOf(dielectric(R"("specularFactor":0.2,"specularColorFactor":[0.2044834,1.005773,0.0139908])"));
  EXPECT_GT(compareImages(left, right).maximum, 0.1f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(textured.at(x, y, channel), (x < 8 ? left : right).at(x, y, channel), 0.003f)
            << x << ' ' << y << ' ' << channel;
}

// ---- Images
// -----------------------------------------------------------------------------------------------

TEST_F(GltfMaterialsTest, TexturesThatLookTheSameAreOne) {
  writeTexture({1, 2, 3}, {4, 5, 6});
  file["images"] = Json::parse(R"([{"uri":"a.png"},{"uri":"./a.png"}])");
  file["samplers"] = Json::parse(R"([{"magFilter":9728},{"magFilter":9729}])");
  file["textures"] =
      Json::parse(R"([{"source":0,"sampler":0},{"source":1,"sampler":0},{"source":0,"sampler":1}])");
  const PBROptions read = optionsOf(loaded(
      R"({"pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}},"normalTexture":{"index":1},)"
      R"("occlusionTexture":{"index":2},"emissiveTexture":{"index":0}})"));
  ASSERT_TRUE(read.normalTexture.image);
  EXPECT_EQ(read.metallicRoughnessTexture.image, read.normalTexture.image);
  EXPECT_NE(read.occlusionTexture.image, read.normalTexture.image) << "another filter";
  EXPECT_NE(read.emissionTexture.image, read.normalTexture.image) << "colours";
}

TEST_F(GltfMaterialsTest, ATextureInAFormatThatWeftDoesNotReadNamesItsExtension) {
  file["textures"][0] = Json::parse(R"({"extensions":{"KHR_texture_basisu":{"source":0}}})");
  EXPECT_THAT(loaded(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})").warnings,
              ElementsAre(testing::AllOf(HasSubstr("base colour"), HasSubstr("KHR_texture_basisu"))));
}

}  // namespace
}  // namespace weft
