// Materials as glTF's specification and Khronos' extensions write them, one feature each, loaded,
// drawn, and compared with the formulas.

#include <gmock/gmock.h>

#include <glm/ext/matrix_transform.hpp>

#include "GlTest.h"
#include "GltfScenes.h"
#include "LitSquare.h"
#include "weft/core/ImageComparison.h"
#include "weft/io/ImageFile.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Shapes.h"

namespace weft::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

struct Feature {
  const char* name;
  const char* material;  ///< as a file has it
  PBROptions expected;
};

std::vector<Feature> features() {
  const glm::vec4 grey(0.5f, 0.5f, 0.5f, 1.0f);
  return {
      {"default", "{}", {}},
      {"metallic-roughness",
       R"({"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.6,0.3,1],"metallicFactor":0.7,"roughnessFactor":0.4}})",
       {.baseColor = {0.9f, 0.6f, 0.3f, 1.0f}, .metallic = 0.7f, .roughness = 0.4f}},
      {"emission",
       R"({"emissiveFactor":[0.1,0.2,0.3],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":3}}})",
       {.emission = {0.3f, 0.6f, 0.9f}}},
      {"ior",
       R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.3},"extensions":{"KHR_materials_ior":{"ior":2}}})",
       {.metallic = 0.0f, .roughness = 0.3f, .refractiveIndex = 2.0f}},
      {"specular",
       R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.3},"extensions":{"KHR_materials_specular":)"
       R"({"specularFactor":0.6,"specularColorFactor":[2,1,0.5]}}})",
       {.metallic = 0.0f, .roughness = 0.3f, .specular = 0.6f, .specularColor = {2, 1, 0.5f}}},
      {"clearcoat",
       R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1]},"emissiveFactor":[1,1,1],"extensions":)"
       R"({"KHR_materials_clearcoat":{"clearcoatFactor":0.8,"clearcoatRoughnessFactor":0.2}}})",
       {.baseColor = grey, .emission = glm::vec3(1), .clearcoat = {.factor = 0.8f, .roughness = 0.2f}}},
      {"sheen",
       R"({"pbrMetallicRoughness":{"metallicFactor":0},"extensions":)"
       R"({"KHR_materials_sheen":{"sheenColorFactor":[0.9,0.5,0.2],"sheenRoughnessFactor":0.5}}})",
       {.metallic = 0.0f, .sheen = {.color = {0.9f, 0.5f, 0.2f}, .roughness = 0.5f}}},
      {"anisotropy",
       R"({"pbrMetallicRoughness":{"roughnessFactor":0.3},"extensions":)"
       R"({"KHR_materials_anisotropy":{"anisotropyStrength":0.6,"anisotropyRotation":1.2}}})",
       {.roughness = 0.3f, .anisotropy = {.strength = 0.6f, .rotation = 1.2f}}},
      {"iridescence",
       R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"roughnessFactor":0.4},"extensions":)"
       R"({"KHR_materials_iridescence":{"iridescenceFactor":0.9,"iridescenceIor":1.8,"iridescenceThicknessMaximum":500}}})",
       {.baseColor = grey,
        .roughness = 0.4f,
        .iridescence = {.factor = 0.9f, .refractiveIndex = 1.8f, .maximumThickness = 500.0f}}},
      {"transmission",
       R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.1},"extensions":)"
       R"({"KHR_materials_transmission":{"transmissionFactor":0.7}}})",
       {.metallic = 0.0f, .roughness = 0.1f, .transmission = {.factor = 0.7f}}},
      {"coat over sheen over a film",
       R"({"pbrMetallicRoughness":{"metallicFactor":0.5,"roughnessFactor":0.4},"extensions":)"
       R"({"KHR_materials_clearcoat":{"clearcoatFactor":0.5,"clearcoatRoughnessFactor":0.3},)"
       R"("KHR_materials_sheen":{"sheenColorFactor":[0.4,0.4,0.4],"sheenRoughnessFactor":0.7},)"
       R"("KHR_materials_iridescence":{"iridescenceFactor":1}}})",
       {.metallic = 0.5f,
        .roughness = 0.4f,
        .clearcoat = {.factor = 0.5f, .roughness = 0.3f},
        .sheen = {.color = glm::vec3(0.4f), .roughness = 0.7f},
        .iridescence = {.factor = 1.0f}}},
  };
}

/// A square that fills the picture, under the lamps of LitSquare.h.
class GltfFeatureTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    folder = testFolder();
    GltfText text;
    text.add<float>({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3");
    text.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    text.add<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    text.add<float>({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2");
    text.add<std::uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    file = triangleGltf(text);
    primitive() = Json::parse(
        R"({"attributes":{"POSITION":0,"NORMAL":1,"TANGENT":2,"TEXCOORD_0":3},"indices":4,"material":0})");
    file["extensions"] = Json::parse(R"({"KHR_lights_punctual":{"lights":[
      {"type":"point","intensity":3,"color":[0.333333333,0.666666667,1]},
      {"type":"point","intensity":0.5,"color":[1,0.8,0.6]}]}})");
    for (int i = 0; i < 2; ++i) {
      const glm::dvec3 at = kLamps[static_cast<std::size_t>(i)].place;
      file["nodes"].push_back(
          {{"translation", {at.x, at.y, at.z}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    file["scenes"][0]["nodes"] = {0, 1, 2};
    file["textures"] = Json::parse(R"([{"source":0,"sampler":0}])");
    file["samplers"] = Json::parse(R"([{"magFilter":9728,"minFilter":9728}])");
    file["images"] = Json::parse(R"([{"uri":"a.png"}])");
  }

  GltfScene loaded(const Json& json) const {
    writeText(folder / "scene.gltf", json.dump());
    return valueOf(loadGltf(folder / "scene.gltf"));
  }

  Json& primitive() { return file["meshes"][0]["primitives"][0]; }

  /// Draws the square with one material, of which nothing is to be left out.
  FloatImage drawn(const std::string& material) {
    file["materials"] = Json::array({Json::parse(material)});
    const GltfScene scene = loaded(file);
    EXPECT_THAT(scene.warnings, IsEmpty()) << material;
    return picture(*scene.root, kSize, kSize, {.background = glm::vec4(0.0f)});
  }

  /// A square picture of texels, as many columns as rows.
  void writeTexture(int side, const std::vector<std::vector<std::uint8_t>>& texels) const {
    Image image(side, side, static_cast<int>(texels[0].size()));
    for (std::size_t i = 0; i < texels.size(); ++i)
      std::copy(texels[i].begin(), texels[i].end(),
                image.pixel(static_cast<int>(i) % side, static_cast<int>(i) / side));
    requireDone(writePng(folder / "a.png", image));
  }

  static constexpr int kSize = 16;
  std::filesystem::path folder;
  Json file;
};

TEST_F(GltfFeatureTest, EachIsShownAsTheSpecificationSays) {
  for (const Feature& feature : features())
    EXPECT_LT(worstDifference(drawn(feature.material), expectedSquare(feature.expected, kSize)), 2e-3f)
        << feature.name;
}

// Five roughnesses by three metals, each a sphere whose normals and places are exact.
TEST_F(GltfFeatureTest, SpheresOverRoughnessAndMetal) {
  constexpr int kColumns = 5, kRows = 3, kPixels = 64;
  const Mesh sphere = makeSphere(48);
  const auto numbers = [](const auto& vectors) {
    std::vector<float> all;
    for (const auto& vector : vectors)
      for (int i = 0; i < vector.length(); ++i) all.push_back(vector[i]);
    return all;
  };
  GltfText text;
  text.add<float>(numbers(sphere.positions), "VEC3");
  text.add<float>(numbers(sphere.normals), "VEC3");
  text.add<std::uint32_t>(sphere.indices, "SCALAR");
  Json spheres = triangleGltf(text);
  spheres["extensions"] = file["extensions"];
  spheres["nodes"] = Json::array();
  for (std::size_t i = 1; i < 3; ++i) spheres["nodes"].push_back(file["nodes"][i]);
  spheres["scenes"][0]["nodes"] = {0, 1};
  spheres["meshes"] = spheres["materials"] = Json::array();
  const auto placeOf = [](int i) {
    return glm::dvec3(0.36 * (i % kColumns - 2), 0.5 * (1 - i / kColumns), -0.3);
  };
  const auto optionsOf = [](int i) {
    return PBROptions{.baseColor = {0.9f, 0.5f, 0.3f, 1.0f},
                      .metallic = 0.5f * static_cast<float>(i / kColumns),
                      .roughness = 0.2f + 0.2f * static_cast<float>(i % kColumns)};
  };
  constexpr double kRadius = 0.17;
  for (int i = 0; i < kColumns * kRows; ++i) {
    const PBROptions options = optionsOf(i);
    const glm::dvec3 place = placeOf(i);
    spheres["materials"].push_back({{"pbrMetallicRoughness",
                                     {{"baseColorFactor", {0.9, 0.5, 0.3, 1.0}},
                                      {"metallicFactor", options.metallic},
                                      {"roughnessFactor", options.roughness}}}});
    spheres["meshes"].push_back(
        {{"primitives",
          {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"material", i}}}}});
    spheres["scenes"][0]["nodes"].push_back(spheres["nodes"].size());
    spheres["nodes"].push_back(
        {{"mesh", i}, {"translation", {place.x, place.y, place.z}}, {"scale", {kRadius, kRadius, kRadius}}});
  }
  const GltfScene scene = loaded(spheres);
  const FloatImage image = picture(*scene.root, kPixels, kPixels, {.background = glm::vec4(0.0f)});
  const SheenTable table;
  double error = 0.0, whole = 0.0;
  for (int y = 0; y < kPixels; ++y)
    for (int x = 0; x < kPixels; ++x) {
      const glm::dvec3 eye(0, 0, 2);
      const glm::dvec3 ray = glm::normalize(
          glm::dvec3((x + 0.5) * 2.0 / kPixels - 1.0, 1.0 - (y + 0.5) * 2.0 / kPixels, 0.0) - eye);
      for (int i = 0; i < kColumns * kRows; ++i) {
        const glm::dvec3 toMiddle = placeOf(i) - eye;
        const double along = glm::dot(toMiddle, ray);
        const double inside = squareOf(kRadius) - glm::dot(toMiddle, toMiddle) + along * along;
        if (inside < squareOf(0.3 * kRadius)) continue;  // outlines fall to either side
        const glm::dvec3 point = eye + (along - std::sqrt(inside)) * ray;
        const glm::dvec3 n = (point - placeOf(i)) / kRadius;
        const glm::dvec3 t = glm::normalize(glm::cross(glm::dvec3(0.3, 1, 0.2), n)), b = glm::cross(n, t);
        const auto inFrame = [&](glm::dvec3 d) {
          return glm::dvec3(glm::dot(d, t), glm::dot(d, b), glm::dot(d, n));
        };
        glm::dvec3 expected(0.0);
        for (const PlacedLight& lamp : kLamps) {
          const glm::dvec3 offset = lamp.place - point;
          expected += lamp.intensity / glm::dot(offset, offset) *
                      shownOfLight(optionsOf(i), table, inFrame(-ray), inFrame(glm::normalize(offset)));
        }
        for (int channel = 0; channel < 3; ++channel) {
          error += std::abs(image.at(x, y, channel) - expected[channel]);
          whole += expected[channel];
        }
      }
    }
  RecordProperty("error", std::to_string(error / whole));
  EXPECT_LT(error / whole, 0.01) << "of triangles, whose points lie below the sphere's";
  EXPECT_GT(whole, 100.0);
}

// The right half has the texture of the left in the mirror, as symmetric models do.
TEST_F(GltfFeatureTest, NormalTexturesWithMirroredTangents) {
  GltfText text;
  text.add<float>({-1, -1, 0, 0, -1, 0, 0, 1, 0, -1, 1, 0, 0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
  text.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  text.add<float>({1,  0, 0, 1,  1,  0, 0, 1,  1,  0, 0, 1,  1,  0, 0, 1,
                   -1, 0, 0, -1, -1, 0, 0, -1, -1, 0, 0, -1, -1, 0, 0, -1},
                  "VEC4");
  text.add<float>({0, 1, 1, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 0, 1, 0}, "VEC2");
  text.add<std::uint8_t>({0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, "SCALAR");
  Json mirrored = triangleGltf(text);
  for (const char* key : {"extensions", "textures", "samplers", "images"}) mirrored[key] = file[key];
  mirrored["extensions"]["KHR_lights_punctual"]["lights"] =
      Json::parse(R"([{"type":"point","intensity":2}])");
  mirrored["nodes"].push_back(
      Json::parse(R"({"translation":[0,0.3,0.7],"extensions":{"KHR_lights_punctual":{"light":0}}})"));
  mirrored["scenes"][0]["nodes"] = {0, 1};
  mirrored["meshes"] = file["meshes"];
  mirrored["materials"] = Json::parse(
      R"([{"normalTexture":{"index":0},"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5}}])");
  writeTexture(2, {{220, 128, 230}, {60, 200, 230}, {128, 60, 220}, {180, 90, 250}});
  const auto shown = [&] {
    return picture(*loaded(mirrored).root, kSize, kSize, {.background = glm::vec4(0.0f)});
  };
  const FloatImage image = shown();
  mirrored["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");  // generated, likewise
  const FloatImage generated = shown();
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize / 2; ++x) {
      EXPECT_NEAR(image.at(x, y, 1), image.at(kSize - 1 - x, y, 1), 1e-4f);
      EXPECT_NEAR(image.at(x, y, 1), generated.at(x, y, 1), 1e-3f);
    }
  EXPECT_GT(std::abs(image.at(2, 2, 1) - image.at(6, 2, 1)), 0.05f) << "the texels differ";
}

TEST_F(GltfFeatureTest, AlphaModes) {
  const auto alphaOf = [&](const std::string& members) {
    return drawn(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]})" + members + "}").at(8, 8, 3);
  };
  EXPECT_EQ(alphaOf(""), 1.0f);
  EXPECT_EQ(alphaOf(R"(,"alphaMode":"OPAQUE")"), 1.0f);
  EXPECT_EQ(alphaOf(R"(,"alphaMode":"MASK")"), 0.0f);
  EXPECT_EQ(alphaOf(R"(,"alphaMode":"MASK","alphaCutoff":0.3)"), 1.0f);
  EXPECT_NEAR(alphaOf(R"(,"alphaMode":"BLEND")"), 0.4f, 1e-5f);
}

// Blender calls opaque things blended, too: by depth they hide what is behind.
TEST_F(GltfFeatureTest, BlendedThingsThatHideAllAreOpaque) {
  const auto modeOf = [&](const std::string& pbr) {
    file["materials"] =
        Json::array({Json::parse(R"({"alphaMode":"BLEND","pbrMetallicRoughness":{)" + pbr + "}}")});
    return dynamic_cast<const PBRMaterial&>(*drawnIn(loaded(file)).at(0).material).options().alphaMode;
  };
  EXPECT_EQ(modeOf(""), AlphaMode::Opaque);
  EXPECT_EQ(modeOf(R"("baseColorFactor":[1,1,1,0.99])"), AlphaMode::Blend);
  const std::string textured = R"("baseColorTexture":{"index":0})";
  writeTexture(2, {{1, 2, 3, 255}, {1, 2, 3, 255}, {1, 2, 3, 255}, {1, 2, 3, 255}});
  EXPECT_EQ(modeOf(textured), AlphaMode::Opaque);
  writeTexture(2, {{1, 2, 3, 255}, {1, 2, 3, 255}, {1, 2, 3, 255}, {1, 2, 3, 254}});
  EXPECT_EQ(modeOf(textured), AlphaMode::Blend);
  writeTexture(1, {{1, 2, 3}});
  EXPECT_EQ(modeOf(textured), AlphaMode::Opaque);
  primitive()["attributes"]["COLOR_0"] = primitive()["attributes"]["TANGENT"];
  EXPECT_EQ(modeOf(textured), AlphaMode::Blend) << "vertices may have alpha";
}

// Each texture of the extensions lies where its own transform puts it: on one texel of four.
TEST_F(GltfFeatureTest, TexturesOfExtensionsAreTransformed) {
  writeTexture(2, {{255, 255, 255, 255}, {90, 120, 60, 100}, {30, 10, 20, 10}, {200, 220, 240, 200}});
  const Json material =
      Json::parse(R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.1},"extensions":{
      "KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatRoughnessFactor":0.8,
        "clearcoatTexture":{"index":0},"clearcoatRoughnessTexture":{"index":0},"clearcoatNormalTexture":{"index":0}},
      "KHR_materials_sheen":{"sheenColorFactor":[1,1,1],"sheenRoughnessFactor":1,
        "sheenColorTexture":{"index":0},"sheenRoughnessTexture":{"index":0}},
      "KHR_materials_anisotropy":{"anisotropyStrength":1,"anisotropyTexture":{"index":0}},
      "KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceThicknessMaximum":800,
        "iridescenceTexture":{"index":0},"iridescenceThicknessTexture":{"index":0}},
      "KHR_materials_transmission":{"transmissionFactor":1,"transmissionTexture":{"index":0}}}})");
  const FloatImage plain = drawn(material.dump());
  int textures = 0;
  for (const auto& [extension, members] : material["extensions"].items())
    for (const auto& [name, member] : members.items()) {
      if (!member.is_object()) continue;
      Json moved = material;
      moved["extensions"][extension][name]["extensions"] =
          Json::parse(R"({"KHR_texture_transform":{"scale":[0,0],"offset":[0.75,0.25]}})");
      const FloatImage image = drawn(moved.dump());
      EXPECT_NEAR(image.at(13, 2, 1), plain.at(13, 2, 1), 1e-4f) << name << ": the texel that lies there";
      EXPECT_GT(compareImages(image, plain).maximum, 1e-3f) << name << ": is everywhere";
      ++textures;
    }
  EXPECT_EQ(textures, 9);
}

TEST_F(GltfFeatureTest, ALayerWithoutTheImageOfItsFactorIsLeftOut) {
  file["materials"] = Json::parse(R"([{"extensions":{
      "KHR_materials_clearcoat":{"clearcoatFactor":1,"clearcoatTexture":{"index":0}},
      "KHR_materials_sheen":{"sheenColorFactor":[1,1,1],"sheenColorTexture":{"index":0}}}}])");
  const GltfScene scene = loaded(file);
  EXPECT_THAT(scene.warnings, testing::ElementsAre(HasSubstr("clearcoat texture")))
      << "one for all uses of an image";
  const auto& options = dynamic_cast<const PBRMaterial&>(*drawnIn(scene).at(0).material).options();
  EXPECT_EQ(options.clearcoat.factor, 0.0f);
  EXPECT_EQ(options.sheen.color, glm::vec3(0.0f));
}

TEST_F(GltfFeatureTest, WhatIsGuessedIsTold) {
  file["materials"] = Json::parse(R"([{"pbrMetallicRoughness":{"metallicFactor":0},"extensions":{
      "KHR_materials_transmission":{"transmissionFactor":1}}}])");
  EXPECT_THAT(loaded(file).warnings, testing::ElementsAre(HasSubstr("shown sharp, although it is rough")));
  file["materials"] =
      Json::parse(R"([{"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":1}}}])");
  EXPECT_THAT(loaded(file).warnings, IsEmpty());
  primitive()["attributes"].erase("TANGENT");
  EXPECT_THAT(loaded(file).warnings, IsEmpty()) << "tangents follow from texture coordinates";
  primitive()["attributes"].erase("TEXCOORD_0");
  EXPECT_THAT(loaded(file).warnings, testing::ElementsAre(HasSubstr("along a guessed direction")));
}

}  // namespace
}  // namespace weft::test
