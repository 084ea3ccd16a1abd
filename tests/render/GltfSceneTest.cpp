// What of a scene is in a glTF file beside triangles and materials: other primitives, poses, data.

#include <gmock/gmock.h>

#include <fstream>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>
#include <random>

#include "FilteredField.h"
#include "GltfScenes.h"
#include "PatchMap.h"
#include "TestField.h"
#include "TestScene.h"
#include "TestSupport.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ImageFile.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scene_io/BtfExtension.h"
#include "weft/scene_io/GltfLoader.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Tangents.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

using test::drawnIn;
using test::DrawnMesh;
using test::failureOfText;
using test::GltfText;
using test::loadedText;
using test::planeGltf;
using test::readText;
using test::replaced;
using test::testFolder;
using test::valueOf;
using test::writtenGltf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The options of the only material.
PBROptions pbrOf(const GltfScene& scene) {
  const auto drawn = drawnIn(scene);
  return dynamic_cast<const PBRMaterial&>(*drawn.at(0).material).options();
}

PBROptions pbrOf(const std::string& material) {
  return pbrOf(loadedText(planeGltf(material)));
}

// ---- Primitives
// -------------------------------------------------------------------------------------------

const std::vector<float> kPentagon{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 0.5f, 0};

GltfScene pentagonScene(int mode, const std::string& attributes = "") {
  GltfText file;
  const int positions = file.add(kPentagon, "VEC3");
  const int indices = file.add<std::uint16_t>({0, 1, 2, 3, 4}, "SCALAR");
  return loadedText(file.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                              std::to_string(positions) + attributes + R"(},"indices":)" +
                              std::to_string(indices) + R"(,"mode":)" + std::to_string(mode) + "}]}]"));
}

TEST(GltfScene, TurnsEveryKindOfPrimitiveIntoLists) {
  const auto meshOf = [](int mode) { return drawnIn(pentagonScene(mode)).at(0).mesh; };
  EXPECT_EQ(meshOf(0)->topology, Topology::Points);
  EXPECT_THAT(meshOf(0)->indices, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(meshOf(2)->topology, Topology::Lines);
  EXPECT_THAT(meshOf(2)->indices, ElementsAre(0, 1, 1, 2, 2, 3, 3, 4, 4, 0)) << "a loop";
  EXPECT_THAT(meshOf(3)->indices, ElementsAre(0, 1, 1, 2, 2, 3, 3, 4)) << "a strip of lines";
  // Flat normals give every corner a vertex of its own, so the corners are compared.
  const auto corners = [&](int mode) {
    std::vector<glm::vec3> points;
    const auto mesh = meshOf(mode);
    EXPECT_EQ(mesh->topology, Topology::Triangles);
    for (const std::uint32_t index : mesh->indices) points.push_back(mesh->positions[index]);
    return points;
  };
  const auto points = [](std::initializer_list<std::size_t> indices) {
    std::vector<glm::vec3> list;
    for (const std::size_t i : indices)
      list.emplace_back(kPentagon[3 * i], kPentagon[3 * i + 1], kPentagon[3 * i + 2]);
    return list;
  };
  EXPECT_EQ(corners(5), points({0, 1, 2, 1, 3, 2, 2, 3, 4})) << "a strip of triangles";
  EXPECT_EQ(corners(6), points({1, 2, 0, 2, 3, 0, 3, 4, 0})) << "a fan";
}

TEST(GltfScene, ShowsLinesAndPointsWithoutNormalsUnlit) {
  EXPECT_TRUE(pbrOf(pentagonScene(3)).unlit);
  EXPECT_FALSE(pbrOf(pentagonScene(3, R"(,"NORMAL":0)")).unlit);
  EXPECT_FALSE(pbrOf(pentagonScene(5)).unlit);
}

TEST(GltfScene, RefusesPrimitivesThatAreNotWhole) {
  GltfText file;
  file.add(std::vector<float>(6), "VEC3");
  file.add(std::vector<float>(3), "VEC3");
  for (const auto& [mode, accessor, message] : {std::tuple(1, 1, "multiple of two"),
                                                {4, 0, "multiple of three"},
                                                {5, 0, "less than three"},
                                                {6, 0, "less than three"},
                                                {3, 1, "single vertex"},
                                                {7, 0, "glTF does not know"}})
    EXPECT_THAT(failureOfText(
                    file.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                              std::to_string(accessor) + R"(},"mode":)" + std::to_string(mode) + "}]}]")),
                HasSubstr(message));
}

// ---- Accessors
// --------------------------------------------------------------------------------------------

std::string triangle(int positions, const std::string& attributes = "") {
  return R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
         std::to_string(positions) + attributes + R"(},"mode":4}]}])";
}

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

TEST(GltfScene, ReadsSparseAccessorsOverOthersAndOverZeros) {
  for (const bool overZeros : {false, true}) {
    GltfText file;
    const int base = file.addView(std::vector<float>{0, 0, 0, 9, 9, 9, 0, 0, 0});
    const int indices = file.addView<std::uint8_t>({1, 2});
    const int values = file.addView(std::vector<float>{1, 0, 0, 0, 1, 0});
    const int positions = file.addAccessor(
        (overZeros ? "" : R"("bufferView":)" + std::to_string(base) + ",") +
        R"("componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":)" +
        std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" +
        std::to_string(values) + "}}");
    const auto mesh = drawnIn(loadedText(file.text(triangle(positions)))).at(0).mesh;
    EXPECT_THAT(mesh->positions, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
  }
}

TEST(GltfScene, ReadsQuantizedAttributes) {
  GltfText file;
  const int positions = file.add<std::int16_t>({0, 0, 0, 100, 0, 0, 0, 100, -50}, "VEC3");
  const int normals =
      file.add<std::int8_t>({0, 0, 127, 0, 127, 0, -127, 0, 0}, "VEC3", R"(,"normalized":true)");
  const int texcoords = file.add<std::uint16_t>({0, 0, 65535, 0, 0, 32768}, "VEC2", R"(,"normalized":true)");
  const std::string attributes =
      R"(,"NORMAL":)" + std::to_string(normals) + R"(,"TEXCOORD_0":)" + std::to_string(texcoords);
  const GltfScene scene = loadedText(
      file.text(R"("extensionsRequired":["KHR_mesh_quantization"],)" + triangle(positions, attributes)));
  const auto mesh = drawnIn(scene).at(0).mesh;
  EXPECT_EQ(mesh->positions[2], glm::vec3(0, 100, -50));
  EXPECT_EQ(mesh->normals[2], glm::vec3(-1, 0, 0));
  EXPECT_NEAR(mesh->texcoords[2].y, 0.5f, 1e-5f);
}

TEST(GltfScene, ReadsVertexColorsWithAndWithoutAlpha) {
  GltfText file;
  const int positions = file.add(kTriangle, "VEC3");
  const int opaque = file.add<std::uint8_t>({255, 0, 51, 0, 0, 0, 0, 0, 0}, "VEC3", R"(,"normalized":true)");
  const int translucent = file.add<float>({1, 0, 0, 0.5f, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC4");
  const auto colorOf = [&](int accessor) {
    const std::string text = file.text(triangle(positions, R"(,"COLOR_0":)" + std::to_string(accessor)));
    return drawnIn(loadedText(text)).at(0).mesh->colors.at(0);
  };
  EXPECT_NEAR(glm::distance(colorOf(opaque), glm::vec4(1, 0, 0.2f, 1)), 0.0f, 1e-6f);
  EXPECT_EQ(colorOf(translucent), glm::vec4(1, 0, 0, 0.5f));
  EXPECT_THAT(drawnIn(loadedText(file.text(triangle(positions)))).at(0).mesh->colors, IsEmpty());
}

// ---- Materials
// --------------------------------------------------------------------------------------------

TEST(GltfScene, ReadsTheFactorsOfAMaterial) {
  const PBROptions read = pbrOf(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":0.6},)"
      R"("emissiveFactor":[0.7,0.8,0.9],"alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,)"
      R"("normalTexture":{"index":0,"scale":2},"occlusionTexture":{"index":0,"strength":0.3},)"
      R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":10},"KHR_materials_ior":{"ior":1.33},)"
      R"("KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,2,3]}}}],)"
      R"("textures":[{"source":0}],"images":[{"uri":"none.png"})");
  EXPECT_EQ(read.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(read.metallic, 0.5f);
  EXPECT_EQ(read.roughness, 0.6f);
  EXPECT_NEAR(glm::distance(read.emission, glm::vec3(7, 8, 9)), 0.0f, 1e-5f);
  EXPECT_EQ(read.alphaMode, AlphaMode::Mask);
  EXPECT_EQ(read.alphaCutoff, 0.25f);
  EXPECT_TRUE(read.doubleSided);
  EXPECT_EQ(read.normalScale, 2.0f);
  EXPECT_EQ(read.occlusionStrength, 0.3f);
  EXPECT_EQ(read.refractiveIndex, 1.33f);
  EXPECT_EQ(read.specular, 0.5f);
  EXPECT_EQ(read.specularColor, glm::vec3(1, 2, 3));
  EXPECT_FALSE(read.unlit);

  const PBROptions plain = pbrOf("{}");
  EXPECT_EQ(plain.metallic, 1.0f);
  EXPECT_EQ(plain.roughness, 1.0f);
  EXPECT_EQ(plain.alphaMode, AlphaMode::Opaque);
  EXPECT_TRUE(pbrOf(R"({"extensions":{"KHR_materials_unlit":{}}})").unlit);
  EXPECT_EQ(
      pbrOf(R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}})").alphaMode,
      AlphaMode::Blend);
}

/// The plane with a second set of texture coordinates, those of its corners mirrored, and a
/// picture.
std::filesystem::path texturedPlane(const std::string& material, glm::vec4 tangent = {1, 0, 0, 1}) {
  GltfText file;
  file.add<float>({-0.5f, 0.5f, 0, 0.5f, 0.5f, 0, -0.5f, -0.5f, 0, 0.5f, -0.5f, 0}, "VEC3");
  file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.add<float>({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
  file.add<float>({1, 0, 0, 0, 1, 1, 0, 1}, "VEC2");
  std::vector<float> tangents;
  for (int i = 0; i < 16; ++i) tangents.push_back(tangent[i % 4]);
  file.add(tangents, "VEC4");
  file.add<std::uint16_t>({0, 2, 3, 0, 3, 1}, "SCALAR");
  const auto path = writtenGltf(file.text(
      R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,)"
      R"("TEXCOORD_3":3,"TANGENT":4},"indices":5,"material":0}]}],"materials":[)" +
      material + R"(],"textures":[{"source":0},{"source":0}],"images":[{"uri":"picture.png"}])"));
  test::requireDone(writePng(path.parent_path() / "picture.png", Image(2, 2, 3)));
  return path;
}

TEST(GltfScene, GivesEachTextureItsCoordinatesAndPlacement) {
  const GltfScene scene = valueOf(loadGltf(texturedPlane(
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":3},"metallicRoughnessTexture":)"
      R"({"index":1,"texCoord":3,"extensions":{"KHR_texture_transform":{"texCoord":0,"offset":[1,2],)"
      R"("rotation":0.5,"scale":[3,-4]}}}},"emissiveTexture":{"index":0}})")));
  EXPECT_THAT(scene.warnings, IsEmpty());
  const PBROptions read = pbrOf(scene);
  EXPECT_EQ(read.baseColorTexture.image, read.emissionTexture.image) << "used twice, made once";
  const auto mesh = drawnIn(scene).at(0).mesh;
  const auto coordinate = [&](const PBRTexture& texture) {
    return (texture.placement.set == 0 ? mesh->texcoords : mesh->texcoords1).at(0);
  };
  EXPECT_EQ(coordinate(read.baseColorTexture), glm::vec2(1, 0)) << "TEXCOORD_3";
  EXPECT_EQ(coordinate(read.emissionTexture), glm::vec2(0, 0)) << "TEXCOORD_0";
  EXPECT_EQ(coordinate(read.metallicRoughnessTexture), glm::vec2(0, 0)) << "the extension's texCoord wins";
  const TexturePlacement& placement = read.metallicRoughnessTexture.placement;
  EXPECT_EQ(placement.offset, glm::vec2(1, 2));
  EXPECT_EQ(placement.scale, glm::vec2(3, -4));
  EXPECT_EQ(placement.rotation, 0.5f);
}

TEST(GltfScene, TangentsBelongToTheCoordinatesOfTheNormalTexture) {
  const glm::vec4 strange(0, 1, 0, 1);
  const auto tangentWith = [&](const std::string& material, const GltfOptions& options = {}) {
    return drawnIn(valueOf(loadGltf(texturedPlane(material, strange), options))).at(0).mesh->tangents.at(0);
  };
  EXPECT_EQ(tangentWith(R"({"normalTexture":{"index":0}})"), strange) << "the file's";
  EXPECT_EQ(tangentWith(R"({"normalTexture":{"index":0,"texCoord":3}})"), strange) << "the file's";
  GltfOptions options;
  options.replacements["base"] = std::make_shared<LambertMaterial>();
  EXPECT_EQ(tangentWith(R"({"name":"base","normalTexture":{"index":0,"texCoord":3}})", options),
            glm::vec4(1, 0, 0, 1))
      << "generated for TEXCOORD_0";
}

TEST(GltfScene, PlacesReflectanceFieldsAndTurnsTheirFrame) {
  const auto meshWith = [](const std::string& more) {
    const auto path =
        texturedPlane(R"({"extensions":{"WEFT_materials_btf":{"uri":"field.rf.exr")" + more + "}}}");
    test::requireDone(writeReflectanceField(test::testField(), path.parent_path() / "field.rf.exr"));
    const GltfScene scene = valueOf(loadGltf(path));
    EXPECT_THAT(scene.warnings, IsEmpty());
    return *drawnIn(scene).at(0).mesh;
  };
  // The same frame as one generated for the coordinates as they are placed.
  const auto expectOwnFrame = [](Mesh mesh) {
    const auto tangents = mesh.tangents;
    generateTangents(mesh);
    ASSERT_EQ(tangents.size(), mesh.tangents.size());
    for (std::size_t i = 0; i < tangents.size(); ++i)
      EXPECT_NEAR(glm::distance(tangents[i], mesh.tangents[i]), 0.0f, 1e-5f);
  };
  const Mesh plain = meshWith("");
  EXPECT_EQ(plain.texcoords.at(1), glm::vec2(1, 0));
  const Mesh other = meshWith(R"(,"texCoord":3)");
  EXPECT_EQ(other.texcoords.at(1), glm::vec2(0, 0));
  EXPECT_EQ(other.tangents.at(0), glm::vec4(-1, 0, 0, -1)) << "TEXCOORD_3 is mirrored";
  const Mesh placed =
      meshWith(R"(,"extensions":{"KHR_texture_transform":{"rotation":0.7,"offset":[1,2],"scale":[2,2]}})");
  EXPECT_NEAR(glm::distance(placed.texcoords.at(1) - placed.texcoords.at(0),
                            2.0f * glm::vec2(std::cos(0.7f), -std::sin(0.7f))),
              0.0f, 1e-5f);
  expectOwnFrame(placed);
  expectOwnFrame(meshWith(R"(,"extensions":{"KHR_texture_transform":{"scale":[-1,1]}})"));
  expectOwnFrame(meshWith(R"(,"extensions":{"KHR_texture_transform":{"rotation":2,"scale":[1,-1]}})"));
}

// ---- Poses
// ------------------------------------------------------------------------------------------------

/// A triangle that one animation of one channel moves.
std::string animated(const std::string& path, const std::string& interpolation,
                     const std::vector<float>& times, const std::vector<float>& values,
                     const std::string& type) {
  GltfText file;
  const int positions = file.add(kTriangle, "VEC3");
  const int input = file.add(times, "SCALAR"), output = file.add(values, type);
  return file.text(triangle(positions) + R"(,"animations":[{"name":"move","samplers":[{"input":)" +
                   std::to_string(input) + R"(,"output":)" + std::to_string(output) +
                   R"(,"interpolation":")" + interpolation +
                   R"("}],"channels":[{"sampler":0,"target":{"node":0,"path":")" + path + R"("}}]}])");
}

glm::vec3 cornerAt(const std::string& text, double time, glm::vec3 corner) {
  const DrawnMesh drawn = drawnIn(loadedText(text, {.time = time})).at(0);
  return glm::vec3(drawn.toWorld * glm::vec4(corner, 1.0f));
}

void expectNear(glm::vec3 actual, glm::vec3 expected) {
  EXPECT_NEAR(glm::distance(actual, expected), 0.0f, 1e-5f)
      << actual.x << ' ' << actual.y << ' ' << actual.z << " instead of " << expected.x << ' ' << expected.y
      << ' ' << expected.z;
}

TEST(GltfScene, SamplesAnimationsAtATime) {
  const std::string linear =
      animated("translation", "LINEAR", {1, 2, 4}, {0, 0, 0, 2, 0, 0, 2, 4, 0}, "VEC3");
  for (const auto& [time, place] : {std::pair(0.0, glm::vec3(0)),
                                    {1.25, {0.5f, 0, 0}},
                                    {3.0, {2, 2, 0}},
                                    {4.0, {2, 4, 0}},
                                    {99.0, {2, 4, 0}}})
    expectNear(cornerAt(linear, time, {0, 0, 0}), place);
  const std::string step = animated("scale", "STEP", {0, 1, 2}, {1, 1, 1, 3, 3, 3, 5, 5, 5}, "VEC3");
  for (const auto& [time, scale] : {std::pair(0.9, 1.0f), {1.0, 3.0f}, {1.9, 3.0f}, {2.0, 5.0f}, {3.0, 5.0f}})
    expectNear(cornerAt(step, time, {1, 0, 0}), {scale, 0, 0});
  // Two keys a quarter turn apart about Z, a third of the way.
  const float h = std::sqrt(0.5f);
  const std::string turn = animated("rotation", "LINEAR", {0, 3}, {0, 0, 0, 1, 0, 0, h, h}, "VEC4");
  expectNear(cornerAt(turn, 1.0, {1, 0, 0}), {std::cos(glm::pi<float>() / 6), 0.5f, 0});
  // x = t^3 on 0..2: the tangents are 0 and 12.
  const std::string spline = animated("translation", "CUBICSPLINE", {0, 2},
                                      {0, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 0, 0, 0}, "VEC3");
  for (const float time : {0.0f, 0.5f, 1.0f, 1.7f, 2.0f})
    expectNear(cornerAt(spline, time, {0, 0, 0}), {time * time * time, 0, 0});

  const GltfScene still = loadedText(linear);
  EXPECT_THAT(still.warnings, ElementsAre(HasSubstr("no time is given")));
  ASSERT_EQ(still.animations.size(), 1u);
  EXPECT_EQ(still.animations[0].name, "move");
  EXPECT_EQ(still.animations[0].seconds, 4.0);
  EXPECT_THAT(failureOfText(linear, {.time = 0.0, .animation = "run"}),
              HasSubstr("there is no animation \"run\""));
  EXPECT_THAT(failureOfText(planeGltf(), {.time = 0.0}), HasSubstr("no animation"));
}

TEST(GltfScene, RefusesBrokenAnimations) {
  const GltfOptions options{.time = 0.5};
  EXPECT_THAT(
      failureOfText(animated("translation", "LINEAR", {1, 1}, std::vector<float>(6), "VEC3"), options),
      HasSubstr("do not increase"));
  EXPECT_THAT(
      failureOfText(animated("translation", "LINEAR", {0, 1}, std::vector<float>(3), "VEC3"), options),
      HasSubstr("as many values as keys"));
  EXPECT_THAT(
      failureOfText(animated("rotation", "CUBICSPLINE", {0, 1}, std::vector<float>(8), "VEC4"), options),
      HasSubstr("as many values as keys"));
  EXPECT_THAT(
      failureOfText(animated("translation", "SMOOTH", {0, 1}, std::vector<float>(6), "VEC3"), options),
      HasSubstr("SMOOTH"));
  EXPECT_THAT(failureOfText(animated("rotation", "LINEAR", {0, 1}, std::vector<float>(6), "VEC3"), options),
              HasSubstr("components"));
}

TEST(GltfScene, MorphsMeshesByTheirWeights) {
  GltfText file;
  const int positions = file.add(kTriangle, "VEC3");
  const int normals = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int up = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int along = file.add<float>({2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3");
  const int times = file.add<float>({0, 1}, "SCALAR"), weights = file.add<float>({0, 0, 1, 0.5f}, "SCALAR");
  const auto number = [](int value) { return std::to_string(value); };
  const auto text = [&](const std::string& node, const std::string& mesh) {
    return file.text(
        R"("nodes":[{"mesh":0)" + node + R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
        number(positions) + R"(,"NORMAL":)" + number(normals) + R"(},"targets":[{"POSITION":)" + number(up) +
        R"(},{"POSITION":)" + number(along) + R"(,"NORMAL":)" + number(along) + "}]}]" + mesh +
        R"(}],"animations":[{"samplers":[{"input":)" + number(times) + R"(,"output":)" + number(weights) +
        R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]}])");
  };
  const auto meshOf = [&](const GltfScene& scene) { return drawnIn(scene).at(0).mesh; };
  EXPECT_EQ(meshOf(loadedText(text("", "")))->positions[1], glm::vec3(1, 0, 0));
  EXPECT_EQ(meshOf(loadedText(text("", R"(,"weights":[0.5,0])")))->positions[1], glm::vec3(1, 0, 0.5f));
  EXPECT_EQ(meshOf(loadedText(text(R"(,"weights":[0,1])", R"(,"weights":[0.5,0])")))->positions[1],
            glm::vec3(3, 0, 0));
  const auto moving = meshOf(loadedText(text("", ""), {.time = 0.5}));
  EXPECT_EQ(moving->positions[1], glm::vec3(1.5f, 0, 0.5f));
  EXPECT_NEAR(glm::distance(moving->normals[1], glm::normalize(glm::vec3(0.5f, 0, 1))), 0.0f, 1e-6f);
}

/// A strip of three triangles' height, whose upper end follows the second joint.
std::string skinned(const std::string& jointNode, const std::string& jointNumbers = "[1,2]") {
  GltfText file;
  const int positions = file.add<float>({0, 0, 0, 1, 0, 0, 0, 2, 0}, "VEC3");
  const int normals = file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int joints = file.add<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  const int weights = file.add<float>({1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0}, "VEC4");
  // The second joint was bound one up.
  const int inverse = file.add<float>(
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
      "MAT4");
  const auto number = [](int value) { return std::to_string(value); };
  return file.text(
      R"("nodes":[{"mesh":0,"skin":0,"translation":[9,9,9],"children":[1]},{"translation":[5,0,0],"children":[2]},)" +
      jointNode + R"(],"skins":[{"joints":)" + jointNumbers + R"(,"inverseBindMatrices":)" + number(inverse) +
      R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + number(positions) + R"(,"NORMAL":)" +
      number(normals) + R"(,"JOINTS_0":)" + number(joints) + R"(,"WEIGHTS_0":)" + number(weights) + "}}]}]");
}

glm::vec3 inWorld(const DrawnMesh& drawn, std::size_t vertex) {
  return glm::vec3(drawn.toWorld * glm::dvec4(drawn.mesh->positions[vertex], 1.0));
}

TEST(GltfScene, SkinsMeshesInTheWorld) {
  // The mesh's own node counts only as the joints' parent.
  const DrawnMesh straight = drawnIn(loadedText(skinned(R"({"translation":[0,1,0]})"))).at(0);
  expectNear(inWorld(straight, 0), {14, 9, 9});
  expectNear(inWorld(straight, 1), {15, 9, 9});
  expectNear(inWorld(straight, 2), {14, 11, 9});
  // The second joint bends by a quarter turn about X: what is one above it comes one before it.
  const DrawnMesh bent =
      drawnIn(loadedText(skinned(R"({"translation":[0,1,0],"rotation":[0.70710678,0,0,0.70710678]})"))).at(0);
  expectNear(inWorld(bent, 0), {14, 9, 9});
  expectNear(inWorld(bent, 2), {14, 10, 10});
  expectNear(bent.mesh->normals[2], {0, -1, 0});
  expectNear(inWorld(bent, 1), {15, 9.5f, 8.5f});

  EXPECT_THAT(failureOfText(skinned("{}", "[1]")), HasSubstr("a joint that its skin does not have"));
  EXPECT_THAT(failureOfText(skinned(R"({},{})", "[1,3]")), HasSubstr("not in the scene"));
  EXPECT_THAT(failureOfText(skinned("{}", "[1,2,1]")), HasSubstr("less matrices than joints"));
}

// ---- Data and hooks
// ---------------------------------------------------------------------------------------

const std::string kForeign = replaced(
    replaced(planeGltf(R"({"name":"base","extras":{"shop":7},"extensions":{"ACME_paint":{"coats":2}}})"),
             R"({"mesh":0,"name":"plane"})",
             R"({"mesh":0,"name":"plane","extensions":{"ACME_door":{"open":true}}})"),
    R"({"asset")",
    R"({"extensionsUsed":["ACME_paint","ACME_door"],"extensions":{"ACME_door":{"hinges":[1,2.5]}},"asset")");

TEST(GltfScene, KeepsUnknownExtensionsAndExtrasAsData) {
  const GltfScene scene = loadedText(kForeign);
  const auto is = [](const std::string& place, const std::string& name, const std::string& json) {
    return testing::AllOf(testing::Field(&GltfData::place, place), testing::Field(&GltfData::name, name),
                          testing::Field(&GltfData::json, json));
  };
  EXPECT_THAT(scene.data, testing::UnorderedElementsAre(is("", "ACME_door", R"({"hinges":[1,2.5]})"),
                                                        is("/nodes/0", "ACME_door", R"({"open":true})"),
                                                        is("/materials/0", "ACME_paint", R"({"coats":2})"),
                                                        is("/materials/0", "extras", R"({"shop":7})")));
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("ACME_paint"), HasSubstr("ACME_door")));
}

TEST(GltfScene, HandsTheProgramItsOwnExtensions) {
  const std::string required =
      replaced(kForeign, R"("extensionsUsed")", R"("extensionsRequired":["ACME_door"],"extensionsUsed")");
  EXPECT_THAT(failureOfText(required), HasSubstr("does not know: ACME_door"));
  std::vector<std::pair<std::string, Node*>> calls;
  GltfOptions options;
  options.extensions["ACME_door"] = [&](const GltfData& data, Node* node) -> Result<void> {
    calls.emplace_back(data.place + data.json, node);
    return {};
  };
  const GltfScene scene = loadedText(required, options);
  EXPECT_THAT(calls,
              testing::UnorderedElementsAre(
                  std::pair(std::string(R"({"hinges":[1,2.5]})"), static_cast<Node*>(nullptr)),
                  std::pair(std::string(R"(/nodes/0{"open":true})"), scene.root->children().at(0).get())));
  EXPECT_EQ(scene.root->children().at(0)->name(), "plane");
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("ACME_paint")));
  options.extensions["ACME_door"] = [](const GltfData&, Node*) -> Result<void> {
    return fail("it is locked");
  };
  EXPECT_THAT(failureOfText(required, options), HasSubstr("it is locked"));
}

TEST(GltfScene, LetsTheProgramMakeMaterials) {
  const auto own = std::make_shared<LambertMaterial>();
  GltfMaterial seen;
  GltfOptions options;
  options.makeMaterial = [&](const GltfMaterial& material) -> Result<std::shared_ptr<const Material>> {
    seen = material;
    const auto json = nlohmann::json::parse(material.json);
    if (json["extensions"]["ACME_paint"]["coats"] == 2) return own;
    return nullptr;
  };
  EXPECT_EQ(drawnIn(loadedText(kForeign, options)).at(0).material, own);
  EXPECT_EQ(seen.name, "base");
  EXPECT_EQ(seen.file.filename(), "scene.gltf");
  EXPECT_EQ(nlohmann::json::parse(seen.json)["extras"]["shop"], 7);
  const GltfScene three = loadedText(replaced(kForeign, R"("coats":2)", R"("coats":3)"), options);
  EXPECT_TRUE(dynamic_cast<const PBRMaterial*>(drawnIn(three).at(0).material.get())) << "Weft's";
  options.makeMaterial = [](const GltfMaterial&) -> Result<std::shared_ptr<const Material>> {
    return fail("no paint left");
  };
  EXPECT_THAT(failureOfText(kForeign, options), HasSubstr("no paint left"));
}

// ---- Writing the extension
// --------------------------------------------------------------------------------

TEST(BtfExtension, IsAddedAndEverythingElseStays) {
  const auto source = writtenGltf(kForeign);
  const auto target = source.parent_path() / "dressed.gltf";
  std::filesystem::create_directory(source.parent_path() / "fields");
  const auto field = source.parent_path() / "fields" / "my wool#1.rf.exr";
  test::requireDone(writeReflectanceField(test::testField(), field));
  test::requireDone(writeBtfExtension(source, target, {{"base", {field, {4, 2.5f}}}}));
  const GltfScene scene = valueOf(loadGltf(target));
  EXPECT_TRUE(dynamic_cast<const BTFMaterial*>(drawnIn(scene).at(0).material.get()));

  auto json = nlohmann::ordered_json::parse(readText(target));
  const auto extension = json["materials"][0]["extensions"]["WEFT_materials_btf"];
  EXPECT_EQ(extension["uri"], "fields/my%20wool%231.rf.exr");
  EXPECT_EQ(extension["scale"], nlohmann::json({4.0, 2.5}));
  EXPECT_EQ(json["extensionsUsed"], nlohmann::json({"ACME_paint", "ACME_door", "WEFT_materials_btf"}));
  json["materials"][0]["extensions"].erase("WEFT_materials_btf");
  json["extensionsUsed"].erase(2);
  EXPECT_EQ(json.dump(), nlohmann::ordered_json::parse(kForeign).dump()) << "the order of members, too";

  // Once more, in place, keeps what somebody else added.
  test::writeText(target,
                  replaced(readText(target), R"("texCoord":0)", R"("texCoord":0,"extras":{"kept":true})"));
  test::requireDone(writeBtfExtension(target, target, {{"base", {field, {1, 1}}}}));
  json = nlohmann::ordered_json::parse(readText(target));
  EXPECT_EQ(json["materials"][0]["extensions"]["WEFT_materials_btf"]["extras"]["kept"], true);
  EXPECT_EQ(json["extensionsUsed"].size(), 3u);
}

TEST(BtfExtension, NamesACoordinateMap) {
  const auto file = writtenGltf(kForeign);
  const auto folder = file.parent_path(), field = folder / "a.rf.exr", map = folder / "my a.coords.exr";
  test::requireDone(writeReflectanceField(test::testField(), field));
  test::requireDone(writeBtfExtension(file, file, {{"base", {field, {1, 1}, 0, map}}}));
  const GltfScene without = valueOf(loadGltf(file));
  EXPECT_FALSE(dynamic_cast<const BTFMaterial*>(drawnIn(without).at(0).material.get()));
  EXPECT_THAT(without.warnings, testing::Contains(HasSubstr("my a.coords.exr: no such file")));

  test::requireDone(writeCoordinateMap(map, test::patchMap({6, 4}, {2, 2}, 2)));
  const GltfScene with = valueOf(loadGltf(file));
  const auto* shown = dynamic_cast<const BTFMaterial*>(drawnIn(with).at(0).material.get());
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->surfaceSize(), glm::ivec2(6, 4));
  EXPECT_THAT(with.files, testing::Contains(map));
  test::requireDone(writeBtfExtension(file, file, {{"base", {field, {1, 1}}}}));
  EXPECT_THAT(readText(file), testing::Not(HasSubstr("coords")));
}

TEST(BtfExtension, TilesAtRandom) {
  const auto file = writtenGltf(kForeign);
  const auto field = file.parent_path() / "a.rf.exr";
  test::requireDone(writeReflectanceField(test::filteredField(8), field));
  const BtfExtension stochastic{.field = field, .tiling = Tiling::Stochastic};
  test::requireDone(writeBtfExtension(file, file, {{"base", stochastic}}));
  const auto tilingOf = [](const GltfScene& scene) {
    const auto* shown = dynamic_cast<const BTFMaterial*>(drawnIn(scene).at(0).material.get());
    return shown ? std::optional(shown->options().tiling) : std::nullopt;
  };
  EXPECT_EQ(tilingOf(valueOf(loadGltf(file))), Tiling::Stochastic);
  test::writeText(file, replaced(readText(file), "stochastic", "hexagonal"));
  const auto refused = loadGltf(file);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("neither repeat nor stochastic"));

  test::requireDone(writeBtfExtension(file, file, {{"base", {field, {1, 1}}}}));
  EXPECT_EQ(tilingOf(valueOf(loadGltf(file))), Tiling::Repeat);
  EXPECT_EQ(tilingOf(valueOf(loadGltf(file, {.btf = {.tiling = Tiling::Stochastic}}))), Tiling::Stochastic);
  test::requireDone(writeReflectanceField(test::testField(), field));
  const GltfScene other = valueOf(loadGltf(file, {.btf = {.tiling = Tiling::Stochastic}}));
  EXPECT_EQ(tilingOf(other), std::nullopt);
  EXPECT_THAT(other.warnings, testing::Contains(HasSubstr("cannot be tiled at random")));
}

TEST(BtfExtension, LeavesTheBinaryChunkAsItIs) {
  const std::string whole = test::planeGlb();
  const auto source = writtenGltf(whole, "scene.glb");
  const auto target = source.parent_path() / "elsewhere" / "dressed.glb";
  std::filesystem::create_directory(target.parent_path());
  const auto field = source.parent_path() / "wool.rf.exr";
  test::requireDone(writeReflectanceField(test::testField(), field));
  test::requireDone(writeBtfExtension(source, target, {{"base", {field}}}));
  EXPECT_TRUE(readText(target).ends_with(whole.substr(whole.find("BIN") - 4)));
  EXPECT_EQ(readText(target).size() % 4, 0u);
  EXPECT_TRUE(dynamic_cast<const BTFMaterial*>(drawnIn(valueOf(loadGltf(target))).at(0).material.get()));
}

TEST(BtfExtension, RefusesWhatItCannotKeep) {
  const auto source = writtenGltf(planeGltf(R"({"name":"base"})", "my.bin"));
  const auto folder = source.parent_path();
  const auto message = [&](const std::filesystem::path& target, const std::string& name) {
    const auto result = writeBtfExtension(source, target, {{name, {folder / "x.rf.exr"}}});
    return result ? std::string("it wrote") : result.error().message();
  };
  EXPECT_THAT(message(folder / "out.gltf", "bass"), HasSubstr("no material \"bass\""));
  std::filesystem::create_directory(folder / "elsewhere");
  EXPECT_THAT(message(folder / "elsewhere" / "out.gltf", "base"), HasSubstr("beside it"));
  test::writeText(source, "no JSON");
  EXPECT_THAT(message(folder / "out.gltf", "base"), HasSubstr("not valid glTF"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.gltf"));
}

// ---- Damaged and other people's files
// ---------------------------------------------------------------------------------

/// A morphed, skinned and animated strip with sparse positions, quantised colours and a placed
/// texture.
std::string richScene() {
  GltfText file;
  const int base = file.addView(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const int sparseIndices = file.addView<std::uint8_t>({1, 3});
  const int sparseValues = file.addView(std::vector<float>{2, 0, 0, 2, 1, 0});
  const auto number = [](int value) { return std::to_string(value); };
  file.addAccessor(R"("bufferView":)" + number(base) +
                   R"(,"componentType":5126,"count":4,"type":"VEC3","sparse":)" +
                   R"({"count":2,"indices":{"bufferView":)" + number(sparseIndices) +
                   R"(,"componentType":5121},"values":{"bufferView":)" + number(sparseValues) + "}}");
  file.add<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  file.add<std::uint8_t>({255, 0, 0, 0, 99, 156, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0}, "VEC4",
                         R"(,"normalized":true)");
  file.add<float>(
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
      "MAT4");
  file.add<float>({0, 1, 2}, "SCALAR");
  file.add<float>({0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC4");
  file.add<float>({0, 1, 0.5f}, "SCALAR");
  file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  file.add<std::uint16_t>({0, 0, 65535, 0, 0, 65535, 65535, 65535}, "VEC2", R"(,"normalized":true)");
  return file.text(
      R"("nodes":[{"mesh":0,"skin":0,"children":[1]},{"children":[2]},{"translation":[0,1,0],"extras":{"a":1}}],)"
      R"("skins":[{"joints":[1,2],"inverseBindMatrices":3}],"animations":[{"samplers":[{"input":4,"output":5},)"
      R"({"input":4,"output":6,"interpolation":"STEP"}],"channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}},)"
      R"({"sampler":1,"target":{"node":0,"path":"weights"}}]}],"materials":[{"alphaMode":"BLEND","pbrMetallicRoughness":)"
      R"({"baseColorTexture":{"index":0,"texCoord":1,"extensions":{"KHR_texture_transform":{"scale":[2,3]}}}}}],)"
      R"("textures":[{"source":0,"sampler":0}],"images":[{"uri":"data:image/png;base64,iVBORw0KGgo="}],"samplers":[{}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2,"COLOR_0":2,"TEXCOORD_1":8},)"
      R"("targets":[{"POSITION":7}],"mode":5,"material":0}]}])");
}

TEST(GltfScene, SurvivesDamageOfEverythingItReads) {
  const std::string whole = richScene();
  const GltfScene scene = loadedText(whole, {.time = 0.5});
  EXPECT_EQ(drawnIn(scene).at(0).mesh->indices.size(), 6u);
  EXPECT_THAT(scene.warnings, ElementsAre(HasSubstr("base colour")))
      << "its image is a PNG signature and nothing more";
  // The base64 of the buffer is left alone most of the time: it is most of the text.
  const std::size_t buffer = whole.find("octet-stream");
  const auto path = testFolder() / "scene.gltf";
  std::mt19937 random(3);
  int survivors = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string damaged = whole;
    for (std::size_t change = random() % 3; change < 3; ++change) {
      char& c = damaged[random() % (random() % 8 == 0 ? damaged.size() : buffer)];
      const auto kind = random() % 8;
      if (std::isdigit(static_cast<unsigned char>(c)) || kind == 0)
        c = static_cast<char>('0' + random() % 10);
      else if (kind == 1)
        c = static_cast<char>(random());
    }
    test::writeText(path, damaged);
    if (loadGltf(path, {.time = 0.5})) ++survivors;
  }
  EXPECT_GT(survivors, 50);
}

TEST(GltfScene, LoadsOrRefusesEveryFileOfAssimpsTestModels) {
  const std::filesystem::path folder = "/usr/share/assimp/models";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "install assimp-testmodels to test with its files";
  int loadedFiles = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    for (const std::optional<double> time : {std::optional<double>(), std::optional<double>(0.7)}) {
      const auto scene = loadGltf(entry.path(), {.time = time});
      if (scene) {
        ++loadedFiles;
        EXPECT_FALSE(scene->bounds.empty());
      } else {
        ++refused;
        EXPECT_THAT(scene.error().message(), HasSubstr(entry.path().filename().string()))
            << "it has a reason";
        EXPECT_GT(scene.error().what.size(), 10u);
      }
    }
  }
  RecordProperty("loaded", loadedFiles);
  RecordProperty("refused", refused);
  EXPECT_GT(loadedFiles, 30);
}

}  // namespace
}  // namespace weft
