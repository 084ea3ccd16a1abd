// EXT_mesh_gpu_instancing, meshes that many primitives share, and what a file may claim.

#include <gmock/gmock.h>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include "GltfScenes.h"
#include "weft/scenegraph/Mesh.h"

namespace weft {
namespace {

using test::drawnIn;
using test::failureOfGltf;
using test::Json;
using test::loadedGltf;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A triangle with instances; the accessors are 0: positions, then those of `instances`, in their
/// order.
Json instancedFile(const std::vector<std::string>& names, const std::vector<std::vector<float>>& numbers) {
  test::GltfText text;
  text.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  Json attributes;
  for (std::size_t i = 0; i < names.size(); ++i)
    attributes[names[i]] = text.add(numbers[i], names[i] == "ROTATION" ? "VEC4"
                                                : names[i][0] == '_'   ? "SCALAR"
                                                                       : "VEC3");
  Json file = test::triangleGltf(text);
  file["nodes"][0]["translation"] = {0, 0, 5};
  file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
  file["extensionsUsed"] = file["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  return file;
}

TEST(GltfInstances, StandWhereTheirAttributesSay) {
  const GltfScene scene = loadedGltf(
      instancedFile({"TRANSLATION", "ROTATION", "SCALE", "_ID"},
                    {{1, 2, 3, 4, 5, 6}, {0, 0, 0, 1, 0, 0, 1.2f, 1.6f}, {1, 1, 1, 2, 1, 0.5f}, {7, 8}}));
  EXPECT_THAT(scene.warnings, IsEmpty());
  const auto drawn = drawnIn(scene);
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(drawn[0].mesh, drawn[1].mesh);
  EXPECT_EQ(drawn[0].toWorld, glm::translate(glm::dmat4(1), glm::dvec3(1, 2, 8)));
  const glm::vec3 corner(drawn[1].toWorld * glm::dvec4(1, 0, 0, 1));
  EXPECT_LT(glm::distance(corner, glm::vec3(4 + 2 * 0.28f, 5 + 2 * 0.96f, 11)), 1e-5f)
      << "scaled, turned by a quaternion that need not be unit, moved, below the node";
}

TEST(GltfInstances, NeedNoMoreThanOneAttribute) {
  EXPECT_EQ(drawnIn(loadedGltf(instancedFile({"SCALE"}, {{1, 1, 1, 2, 2, 2, 3, 3, 3}}))).size(), 3u);
  EXPECT_EQ(drawnIn(loadedGltf(instancedFile({"_ID"}, {{1, 2}}))).size(), 2u) << "of an application";
}

TEST(GltfInstances, MayBeWholeNumbers) {
  Json file = instancedFile({"TRANSLATION"}, {{0, 0, 0}});
  test::GltfText text;
  text.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.add<std::int16_t>({0, 0, 0, 32767, -32767, 0, 0, 0}, "VEC4", R"(,"normalized":true)");
  const Json other = test::triangleGltf(text);
  for (const char* key : {"accessors", "bufferViews", "buffers"}) file[key] = other[key];
  file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"ROTATION", 1}};
  const auto drawn = drawnIn(loadedGltf(file));
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_LT(glm::distance(drawn[1].toWorld * glm::dvec4(1, 0, 0, 0), glm::dvec4(1, 0, 0, 0)), 1.1);
}

TEST(GltfInstances, OfDifferentLengthsOrBrokenAreRefused) {
  EXPECT_THAT(failureOfGltf(instancedFile({"TRANSLATION", "SCALE"}, {{1, 2, 3}, {1, 1, 1, 2, 2, 2}})),
              AllOf(HasSubstr("EXT_mesh_gpu_instancing"), HasSubstr("length")));
  EXPECT_THAT(failureOfGltf(instancedFile({}, {})), HasSubstr("EXT_mesh_gpu_instancing"));
  Json file = instancedFile({"TRANSLATION"}, {{1, 2, 3}});
  file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 7;
  EXPECT_THAT(failureOfGltf(file), HasSubstr("accessor 7"));
}

// ---- One mesh for many
// ------------------------------------------------------------------------------------

TEST(GltfMeshes, AreMadeOnceForAllMaterialsAndNodes) {
  Json file = test::triangleGltf();
  const Json primitive = file["meshes"][0]["primitives"][0];
  for (int i = 0; i < 300; ++i) {
    file["materials"].push_back({{"name", std::to_string(i)}});
    file["meshes"][i]["primitives"] = {primitive, primitive};
    file["meshes"][i]["primitives"][1]["material"] = i;
    file["nodes"][i]["mesh"] = i;
    file["scenes"][0]["nodes"][i] = i;
  }
  const auto drawn = drawnIn(loadedGltf(file));
  ASSERT_EQ(drawn.size(), 600u);
  for (const test::DrawnMesh& one : drawn) EXPECT_EQ(one.mesh, drawn[0].mesh);
  EXPECT_NE(drawn[1].material, drawn[3].material);
}

TEST(GltfMeshes, AreNotSharedByWhatDiffers) {
  test::GltfText text;
  text.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.add<std::uint8_t>({0, 2, 1}, "SCALAR");
  text.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  Json file = test::triangleGltf(text);
  file["meshes"][0] = Json::parse(R"({"weights":[1],"primitives":[{"attributes":{"POSITION":0}},
    {"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"mode":3},
    {"attributes":{"POSITION":0,"NORMAL":2}},{"attributes":{"POSITION":0},"targets":[{"POSITION":2}]}]})");
  file["nodes"] = Json::parse(R"([{"mesh":0},{"mesh":0,"weights":[2]}])");
  file["scenes"][0]["nodes"] = {0, 1};
  const auto drawn = drawnIn(loadedGltf(file));
  ASSERT_EQ(drawn.size(), 10u);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(drawn[i].mesh, drawn[k].mesh) << i << ' ' << k;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(drawn[i].mesh, drawn[i + 5].mesh);
  EXPECT_NE(drawn[4].mesh, drawn[9].mesh) << "another weight";
}

TEST(GltfMeshes, HoldTheVerticesThatTheirIndicesUse) {
  // A list of 1000 vertices with colours, which three primitives share.
  std::vector<float> positions, normals, colors;
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<float>(i);
    positions.insert(positions.end(), {x, x * x, 0});
    normals.insert(normals.end(), {0, 0, 1});
    colors.insert(colors.end(), {x / 1000.0f, 0, 0});
  }
  test::GltfText text;
  text.add(positions, "VEC3");
  text.add(normals, "VEC3");
  text.add(colors, "VEC3");
  text.add<std::uint16_t>({500, 998, 501, 500, 502, 501}, "SCALAR");
  text.add<std::uint16_t>({0, 1, 999}, "SCALAR");
  Json file = test::triangleGltf(text);
  const Json attributes = Json::parse(R"({"POSITION":0,"NORMAL":1,"COLOR_0":2})");
  file["meshes"][0]["primitives"] = {{{"attributes", attributes}, {"indices", 3}},
                                     {{"attributes", attributes}, {"indices", 4}}};
  const auto drawn = drawnIn(loadedGltf(file));
  const Mesh& mesh = *drawn.at(0).mesh;
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_THAT(mesh.indices, testing::ElementsAre(0, 3, 1, 0, 2, 1)) << "in the order of the list";
  EXPECT_EQ(mesh.positions[3], glm::vec3(998, 998 * 998, 0));
  EXPECT_EQ(mesh.colors[3], glm::vec4(0.998f, 0, 0, 1));
  EXPECT_EQ(drawn.at(1).mesh->positions[2], glm::vec3(999, 999 * 999, 0));
}

// ---- Zeros
// ------------------------------------------------------------------------------------------------

TEST(GltfZeros, AnAccessorWithoutBytesIsZeros) {
  test::GltfText text;
  text.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.addAccessor(R"("componentType":5126,"count":3,"type":"VEC3")");
  text.addAccessor(R"("componentType":5126,"count":3,"type":"VEC2")");
  text.addAccessor(R"("componentType":5121,"normalized":true,"count":3,"type":"VEC4")");
  Json file = test::triangleGltf(text);
  file["meshes"][0] = Json::parse(R"({"weights":[1],"primitives":[
    {"attributes":{"POSITION":0,"TEXCOORD_0":2,"COLOR_0":3},"targets":[{"POSITION":1}]}]})");
  const auto mesh = drawnIn(loadedGltf(file)).at(0).mesh;
  EXPECT_EQ(mesh->positions[1], glm::vec3(1, 0, 0)) << "a morph target that moves nothing";
  EXPECT_EQ(mesh->texcoords[1], glm::vec2(0));
  EXPECT_EQ(mesh->colors[1], glm::vec4(0));

  // Indices that all name the first vertex: a triangle without an area beside another.
  file["accessors"].push_back({{"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}});
  file["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 4}});
  EXPECT_THAT(drawnIn(loadedGltf(file)).at(1).mesh->indices.size(), 3u);
}

// ---- What a file may claim
// --------------------------------------------------------------------------------

/// Refused with the file, and because of what it would take.
testing::Matcher<std::string> isTooLarge() {
  return AllOf(HasSubstr("scene.gltf: "), HasSubstr(" MB that a file of this size may take"));
}

TEST(GltfMemory, ClaimsWithoutBytesAreRefused) {
  Json file = test::triangleGltf();
  file["accessors"][0].erase("bufferView");
  file["accessors"][0]["count"] = 30'000'000;
  EXPECT_THAT(failureOfGltf(file), isTooLarge()) << "zeros";

  test::GltfText sparse;
  sparse.addView<std::uint8_t>({1});
  sparse.addView<float>({1, 0, 0});
  sparse.addAccessor(R"("componentType":5126,"count":30000000,"type":"VEC3","sparse":{"count":1,)"
                     R"("indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":1}})");
  EXPECT_THAT(failureOfGltf(test::triangleGltf(sparse)), isTooLarge());

  file = test::triangleGltf();
  file["accessors"].push_back({{"componentType", 5121}, {"count", 30'000'000}, {"type", "SCALAR"}});
  file["meshes"][0]["primitives"][0]["indices"] = 1;
  EXPECT_THAT(failureOfGltf(file), isTooLarge()) << "indices";
  file["accessors"][1]["count"] = 15'000'000;
  file["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_THAT(failureOfGltf(file), isTooLarge()) << "a strip, whose triangles take more than its indices";
}

TEST(GltfMemory, OneAccessorInManyMeshesIsRefusedWhereItTakesTooMuch) {
  Json file = test::triangleGltf();
  file["accessors"][0].erase("bufferView");
  file["accessors"][0]["count"] = 30'000;
  for (int i = 0; i < 300; ++i)
    file["meshes"][0]["primitives"][i]["attributes"] = {{"POSITION", 0}, {"_" + std::to_string(i), 0}};
  EXPECT_THAT(failureOfGltf(file), isTooLarge());
}

TEST(GltfMemory, InstancesAreCounted) {
  Json file = instancedFile({"TRANSLATION"}, {{1, 2, 3}});
  file["accessors"][1].erase("bufferView");
  file["accessors"][1]["count"] = 100'000'000;
  EXPECT_THAT(failureOfGltf(file), isTooLarge());
  file["accessors"][1]["count"] = 1000;
  for (int i = 0; i < 1000; ++i) {
    file["nodes"][i] = file["nodes"][0];
    file["scenes"][0]["nodes"][i] = i;
  }
  EXPECT_THAT(failureOfGltf(file), isTooLarge());
}

TEST(GltfMemory, AnimationsAreCounted) {
  Json file = test::triangleGltf();
  file["accessors"].push_back({{"componentType", 5126}, {"count", 2'000'000'000}, {"type", "SCALAR"}});
  file["animations"] = Json::parse(R"([{"channels":[{"sampler":0,"target":{"node":0,"path":"scale"}}],
    "samplers":[{"input":1,"output":0}]}])");
  EXPECT_THAT(failureOfGltf(file), isTooLarge());
}

}  // namespace
}  // namespace weft
