// Meshes packed with Draco and meshoptimizer, which the tests pack themselves.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <glm/geometric.hpp>
#include <random>

#include "GltfScenes.h"
#include "weft/scenegraph/Mesh.h"

#ifdef WEFT_DRACO
#include <draco/compression/encode.h>
#endif
#ifdef WEFT_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace weft {
namespace {

using test::drawnIn;
using test::failureOfGltf;
using test::Json;
using test::loadedGltf;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A hilly square of 9 x 9 vertices.
struct Hills {
  static constexpr std::uint32_t kSide = 9;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> texcoords;
  std::vector<std::uint32_t> indices;

  Hills() {
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        positions.emplace_back(x, y, static_cast<float>((x * y) % 4));
        texcoords.emplace_back(static_cast<float>(x) / 8.0f, static_cast<float>(y) / 8.0f);
      }
    for (std::uint32_t y = 0; y + 1 < kSide; ++y)
      for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
        const std::uint32_t i = y * kSide + x;
        for (const std::uint32_t corner : {i, i + 1, i + kSide, i + 1, i + kSide + 1, i + kSide})
          indices.push_back(corner);
      }
  }
};

/// Corners of triangles, positions and texture coordinates, each triangle from its smallest corner
/// on, sorted: equal for the same triangles in any order.
std::vector<std::array<std::array<float, 5>, 3>> trianglesOf(const std::vector<glm::vec3>& positions,
                                                             const std::vector<glm::vec2>& texcoords,
                                                             const std::vector<std::uint32_t>& indices) {
  std::vector<std::array<std::array<float, 5>, 3>> triangles(indices.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = indices[3 * i + k];
      triangles[i][k] = {positions[v].x, positions[v].y, positions[v].z, texcoords[v].x, texcoords[v].y};
    }
    std::rotate(triangles[i].begin(), std::min_element(triangles[i].begin(), triangles[i].end()),
                triangles[i].end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

[[maybe_unused]] void expectIsHills(const Mesh& mesh) {
  const Hills hills;
  EXPECT_EQ(trianglesOf(mesh.positions, mesh.texcoords, mesh.indices),
            trianglesOf(hills.positions, hills.texcoords, hills.indices));
}

/// The hills, there in Draco alone.
Json dracoFile(const std::vector<std::uint8_t>& packed) {
  test::GltfText text;
  text.addView(packed);
  text.addAccessor(R"("componentType":5126,"count":81,"type":"VEC3")");
  text.addAccessor(R"("componentType":5126,"count":81,"type":"VEC2")");
  text.addAccessor(R"("componentType":5123,"count":384,"type":"SCALAR")");
  Json file = test::triangleGltf(text);
  file["meshes"][0]["primitives"][0] = Json::parse(
      R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"mode":4,"extensions":{
          "KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}}})");
  file["extensionsUsed"] = file["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return file;
}

#ifdef WEFT_DRACO

/// `bits` of each number; 0: as they are.
std::vector<std::uint8_t> packedWithDraco(int method, int bits = 0) {
  const Hills hills;
  const auto count = static_cast<std::uint32_t>(hills.positions.size());
  draco::Mesh mesh;
  mesh.set_num_points(count);
  const auto add = [&](draco::GeometryAttribute::Type type, const auto& values) {
    draco::GeometryAttribute attribute;
    attribute.Init(type, nullptr, static_cast<std::uint8_t>(values[0].length()), draco::DT_FLOAT32, false,
                   static_cast<std::int64_t>(sizeof values[0]), 0);
    const int id = mesh.AddAttribute(attribute, true, count);
    for (std::uint32_t i = 0; i < count; ++i)
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), &values[i]);
  };
  add(draco::GeometryAttribute::POSITION, hills.positions);
  add(draco::GeometryAttribute::TEX_COORD, hills.texcoords);
  for (std::size_t i = 0; i < hills.indices.size(); i += 3)
    mesh.AddFace({draco::PointIndex(hills.indices[i]), draco::PointIndex(hills.indices[i + 1]),
                  draco::PointIndex(hills.indices[i + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  // Texture coordinates follow the positions, where both are rounded.
  encoder.SetSpeedOptions(0, 0);
  for (const auto type : {draco::GeometryAttribute::POSITION, draco::GeometryAttribute::TEX_COORD})
    if (bits > 0) encoder.SetAttributeQuantization(type, bits);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.data() + buffer.size()};
}

class GltfDraco : public testing::TestWithParam<int> {};

TEST_P(GltfDraco, IsUnpacked) {
  Json file = dracoFile(packedWithDraco(GetParam()));
  const GltfScene scene = loadedGltf(file);
  expectIsHills(*drawnIn(scene).at(0).mesh);
  EXPECT_THAT(scene.warnings, IsEmpty());

  file.erase("extensionsRequired");
  expectIsHills(*drawnIn(loadedGltf(file)).at(0).mesh);
  file["meshes"][0]["primitives"][0].erase("indices");
  expectIsHills(*drawnIn(loadedGltf(file)).at(0).mesh);
}

TEST_P(GltfDraco, EveryTruncationIsRefusedByItsName) {
  const std::vector<std::uint8_t> packed = packedWithDraco(GetParam());
  for (std::size_t size = 0; size < packed.size(); size += 7)
    EXPECT_THAT(
        failureOfGltf(dracoFile({packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size)})),
        HasSubstr("KHR_draco_mesh_compression of mesh 0"))
        << size;
}

TEST_P(GltfDraco, SurvivesDamage) {
  const std::vector<std::uint8_t> packed = packedWithDraco(GetParam());
  std::mt19937 random(5);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<std::uint8_t> damaged = packed;
    for (auto change = random() % 3; change < 3; ++change)
      damaged[11 + random() % (damaged.size() - 11)] = static_cast<std::uint8_t>(random());
    if (!loadGltf(test::writtenGltf(dracoFile(damaged).dump()))) ++refused;
  }
  EXPECT_GT(refused, 10);
}

INSTANTIATE_TEST_SUITE_P(Methods, GltfDraco,
                         testing::Values(draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING));

TEST(GltfDracoFile, WithOtherBytesForThoseWhoCannotUnpackShowsThese) {
  Json file = dracoFile({1, 2, 3});
  test::GltfText plain;
  const Hills hills;
  std::vector<float> positions, texcoords;
  for (const glm::vec3 p : hills.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  for (const glm::vec2 t : hills.texcoords) texcoords.insert(texcoords.end(), {t.x, t.y});
  plain.add(positions, "VEC3");
  plain.add(texcoords, "VEC2");
  plain.add(hills.indices, "SCALAR");
  Json complete = test::triangleGltf(plain);
  complete["meshes"] = file["meshes"];
  expectIsHills(*drawnIn(loadedGltf(complete)).at(0).mesh);
}

TEST(GltfDracoFile, ThatClaimsMoreThanItsSizeIsRefusedBeforeMemoryIsTaken) {
  const std::vector<std::uint8_t> header{'D', 'R', 'A', 'C', 'O', 2, 2, 1};
  for (const std::uint8_t method : {std::uint8_t{0}, std::uint8_t{1}}) {
    std::vector<std::uint8_t> bytes = header;
    bytes.insert(bytes.end(), {method, 0, 0});
    if (method == 1) bytes.push_back(0);
    bytes.insert(bytes.end(), {0x8f, 0xff, 0xff, 0xff, 0x7f, 0x8f, 0xff, 0xff, 0xff, 0x7f, 0});
    EXPECT_THAT(failureOfGltf(dracoFile(bytes)), AllOf(HasSubstr("MB"), HasSubstr("size")));
  }
}

TEST(GltfDracoFile, OfManyAttributesIsRefusedBeforeMemoryIsTaken) {
  std::vector<std::uint8_t> bytes = packedWithDraco(draco::MESH_SEQUENTIAL_ENCODING);
  constexpr std::uint8_t kPosition[]{draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, 0};
  const auto position = std::search(bytes.begin(), bytes.end(), std::begin(kPosition), std::end(kPosition));
  ASSERT_NE(position, bytes.end());
  bytes.erase(position - 1, bytes.end());  // their number, then each
  bytes.insert(bytes.end(), {0x90, 0x03});
  for (int i = 0; i < 400; ++i)
    bytes.insert(bytes.end(), {draco::GeometryAttribute::GENERIC, draco::DT_FLOAT32, 255, 0, 0});
  bytes.resize(bytes.size() + 400);  // how they are packed
  EXPECT_THAT(failureOfGltf(dracoFile(bytes)), AllOf(HasSubstr("MB"), HasSubstr("size")));
}

TEST(GltfDracoFile, WithABrokenNumberIsToldAtOnce) {
  const std::vector<std::uint8_t> packed = packedWithDraco(draco::MESH_EDGEBREAKER_ENCODING, 11);
  for (std::size_t i = 11; i < packed.size(); ++i) {
    std::vector<std::uint8_t> damaged = packed;
    damaged[i] = 127;
    const auto start = std::chrono::steady_clock::now();
    static_cast<void>(loadGltf(test::writtenGltf(dracoFile(damaged).dump())));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2)) << i;
  }
}

TEST(GltfDracoFile, WithoutAnAttributeThatItNamesIsRefused) {
  Json file = dracoFile(packedWithDraco(draco::MESH_SEQUENTIAL_ENCODING));
  auto& attributes =
      file["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"];
  attributes["TEXCOORD_0"] = 5;
  EXPECT_THAT(failureOfGltf(file), HasSubstr("TEXCOORD_0"));
  attributes["TEXCOORD_0"] = 0;
  EXPECT_THAT(failureOfGltf(file), HasSubstr("components"));
}

#else

TEST(GltfDracoFile, IsRefusedByItsName) {
  Json file = dracoFile({1, 2, 3});
  EXPECT_THAT(failureOfGltf(file), HasSubstr("KHR_draco_mesh_compression"));
  file.erase("extensionsRequired");
  EXPECT_THAT(failureOfGltf(file), HasSubstr("KHR_draco_mesh_compression of mesh 0 cannot be unpacked"));
}

#endif

#ifdef WEFT_MESHOPTIMIZER

template <class Vertex>
std::vector<std::uint8_t> packedVertices(const std::vector<Vertex>& vertices) {
  std::vector<std::uint8_t> bytes(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(Vertex)));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(), vertices.size(),
                                          sizeof(Vertex)));
  return bytes;
}

std::vector<std::uint8_t> packedIndices(const std::vector<std::uint32_t>& indices, bool triangles) {
  std::vector<std::uint8_t> bytes(triangles ? meshopt_encodeIndexBufferBound(indices.size(), 81)
                                            : meshopt_encodeIndexSequenceBound(indices.size(), 81));
  bytes.resize(triangles
                   ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size())
                   : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

/// A file of packed views, whose bytes for other programs are not there.
class PackedViews {
 public:
  /// One view and one accessor; `filter`: members of the extension, each after a comma.
  void add(const std::vector<std::uint8_t>& packed, std::size_t count, std::size_t stride,
           const std::string& mode, const std::string& accessor, const std::string& filter = "") {
    const int source = text_.addView(packed);
    views_.push_back(Json::parse(R"({"buffer":1,"byteLength":)" + std::to_string(count * stride) +
                                 R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":)" +
                                 std::to_string(packed.size()) + R"(,"byteStride":)" +
                                 std::to_string(stride) + R"(,"count":)" + std::to_string(count) +
                                 R"(,"mode":")" + mode + '"' + filter + "}}}"));
    text_.addAccessor(R"("bufferView":)" + std::to_string(source) + R"(,"count":)" + std::to_string(count) +
                      "," + accessor);
  }

  /// With "attributes", "indices" and more of the primitive.
  Json file(const std::string& primitive) const {
    Json file = test::triangleGltf(text_);
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const Json offset = file["bufferViews"][i]["byteOffset"];
      file["bufferViews"][i] = views_[i];
      file["bufferViews"][i]["extensions"]["EXT_meshopt_compression"]["byteOffset"] = offset;
    }
    file["buffers"].push_back(
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    file["meshes"][0]["primitives"][0] = Json::parse(primitive);
    file["extensionsUsed"] = file["extensionsRequired"] = {"EXT_meshopt_compression"};
    return file;
  }

 private:
  test::GltfText text_;
  std::vector<Json> views_;
};

constexpr const char* kVec3 = R"("componentType":5126,"type":"VEC3")";

Json meshoptFile(bool triangles, std::size_t indexSize = 4) {
  const Hills hills;
  PackedViews views;
  views.add(packedVertices(hills.positions), 81, 12, "ATTRIBUTES", kVec3);
  views.add(packedVertices(hills.texcoords), 81, 8, "ATTRIBUTES", R"("componentType":5126,"type":"VEC2")");
  views.add(packedIndices(hills.indices, triangles), hills.indices.size(), indexSize,
            triangles ? "TRIANGLES" : "INDICES",
            R"("type":"SCALAR","componentType":)" + std::string(indexSize == 4 ? "5125" : "5123"));
  return views.file(R"({"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2})");
}

TEST(GltfMeshopt, IsUnpackedInEveryMode) {
  for (const bool triangles : {false, true})
    for (const std::size_t size : {2, 4}) {
      const GltfScene scene = loadedGltf(meshoptFile(triangles, size));
      expectIsHills(*drawnIn(scene).at(0).mesh);
      EXPECT_THAT(scene.warnings, IsEmpty());
    }
}

TEST(GltfMeshopt, FiltersAreUndone) {
  const std::vector<glm::vec4> normals{{0, 0, 1, 0}, {0.6f, 0, 0.8f, 0}, {0, -1, 0, 0}};
  std::vector<std::array<std::int8_t, 4>> packedNormals(3);
  meshopt_encodeFilterOct(packedNormals.data(), 3, 4, 8, &normals[0].x);
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1.5f, 0, 0}, {0, -2, 0.25f}};
  std::vector<std::array<std::uint32_t, 3>> packedPositions(3);
  meshopt_encodeFilterExp(packedPositions.data(), 3, 12, 20, &positions[0].x);
  PackedViews views;
  views.add(packedVertices(packedPositions), 3, 12, "ATTRIBUTES", kVec3, R"(,"filter":"EXPONENTIAL")");
  views.add(packedVertices(packedNormals), 3, 4, "ATTRIBUTES",
            R"("componentType":5120,"normalized":true,"type":"VEC3")", R"(,"filter":"OCTAHEDRAL")");
  const auto mesh = drawnIn(loadedGltf(views.file(R"({"attributes":{"POSITION":0,"NORMAL":1}})"))).at(0).mesh;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(mesh->positions[i], positions[i]), 1e-5f);
    EXPECT_LT(glm::distance(mesh->normals[i], glm::vec3(normals[i])), 0.02f);
  }

  // Quaternions turn the instances of a mesh.
  const std::vector<glm::vec4> turns{{0, 0, 0, 1}, {0, 0.6f, 0, 0.8f}};
  std::vector<std::array<std::int16_t, 4>> packedTurns(2);
  meshopt_encodeFilterQuat(packedTurns.data(), 2, 8, 16, &turns[0].x);
  views.add(packedVertices(packedTurns), 2, 8, "ATTRIBUTES",
            R"("componentType":5122,"normalized":true,"type":"VEC4")", R"(,"filter":"QUATERNION")");
  Json file = views.file(R"({"attributes":{"POSITION":0}})");
  file["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = 2;
  const auto drawn = drawnIn(loadedGltf(file));
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_LT(glm::distance(glm::vec3(drawn[1].toWorld[0]), glm::vec3(0.28f, 0, -0.96f)), 1e-3f);
}

TEST(GltfMeshopt, WithOtherBytesIsUnpackedToo) {
  Json file = meshoptFile(true);
  file["buffers"][1]["uri"] = "data:;base64,AAAA";
  file["buffers"][1]["byteLength"] = 3;
  expectIsHills(*drawnIn(loadedGltf(file)).at(0).mesh);
}

TEST(GltfMeshopt, WhatIsBrokenIsRefusedByItsName) {
  const auto with = [](const char* key, const Json& value) {
    Json file = meshoptFile(true);
    file["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    return failureOfGltf(file);
  };
  const auto named = [](const char* why) {
    return AllOf(HasSubstr("buffer view 0"), HasSubstr(why), HasSubstr("EXT_meshopt_compression"));
  };
  EXPECT_THAT(with("mode", "CUBES"), named("mode"));
  EXPECT_THAT(with("filter", "COFFEE"), named("filter"));
  EXPECT_THAT(with("filter", "OCTAHEDRAL"), named("stride"));
  EXPECT_THAT(with("byteStride", 10), named("stride"));
  EXPECT_THAT(with("byteStride", 0), named("stride"));
  EXPECT_THAT(with("byteLength", 20), named("broken"));
  EXPECT_THAT(with("count", 2'000'000'000), named("more than its bytes can hold"));
  EXPECT_THAT(with("byteOffset", 1'000'000), HasSubstr("beyond its buffer"));
  EXPECT_THAT(with("buffer", 9), HasSubstr("buffer that does not exist"));
}

TEST(GltfMeshopt, AsPackedAsCanBeIsUnpacked) {
  // 64 bytes of each: a mesh of a single point, which nothing sensible holds, but the format does.
  const std::vector<glm::vec3> points(65536);
  PackedViews views;
  views.add(packedVertices(points), points.size(), 12, "ATTRIBUTES", kVec3);
  EXPECT_EQ(drawnIn(loadedGltf(views.file(R"({"attributes":{"POSITION":0},"mode":0})"))).size(), 1u);
}

TEST(GltfMeshopt, SurvivesDamage) {
  const Json file = meshoptFile(true);
  const std::string uri = file["buffers"][0]["uri"];
  const std::size_t start = uri.find(',') + 1;
  std::mt19937 random(6);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string damaged = uri;
    for (auto change = random() % 3; change < 3; ++change)
      damaged[start + random() % (damaged.size() - start - 4)] = static_cast<char>('A' + random() % 26);
    Json other = file;
    other["buffers"][0]["uri"] = damaged;
    if (!loadGltf(test::writtenGltf(other.dump()))) ++refused;
  }
  EXPECT_GT(refused, 10);
}

#endif

}  // namespace
}  // namespace weft
