#include "weft/scene_io/GltfLoader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <sstream>

#include "GltfScenes.h"
#include "TestField.h"
#include "weft/io/ImageFile.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/materials/PBRMaterial.h"
#include "weft/scenegraph/Light.h"
#include "weft/scenegraph/Shapes.h"
#include "weft/scenegraph/Tangents.h"
#include "weft/scenegraph/Transform.h"

namespace weft {
namespace {

using test::BufferBytes;
using test::drawnIn;
using test::DrawnMesh;
using test::failureOfText;
using test::loadedText;
using test::planeBuffer;
using test::planeGlb;
using test::planeGltf;
using test::replaced;
using test::testFolder;
using test::valueOf;
using test::writtenGltf;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

template <class Core>
const Core* firstOf(const Node& node) {
  if (const auto* core = dynamic_cast<const Core*>(&node.core())) return core;
  for (const auto& child : node.children())
    if (const Core* core = firstOf<Core>(*child)) return core;
  return nullptr;
}

void expectIsThePlane(const Mesh& mesh) {
  const Mesh plane = makePlane();
  EXPECT_EQ(mesh.positions, plane.positions);
  EXPECT_EQ(mesh.normals, plane.normals);
  EXPECT_EQ(mesh.tangents, plane.tangents);
  EXPECT_EQ(mesh.texcoords, plane.texcoords);
  EXPECT_EQ(mesh.indices, plane.indices);
}

TEST(GltfLoader, ReadsAMesh) {
  const GltfScene scene = loadedText(planeGltf());
  ASSERT_EQ(drawnIn(scene).size(), 1u);
  expectIsThePlane(*drawnIn(scene)[0].mesh);
  EXPECT_THAT(scene.materials, ElementsAre("base"));
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_EQ(scene.bounds.minimum, glm::dvec3(-0.5, -0.5, 0.0));
}

TEST(GltfLoader, ReadsTheBinaryForm) {
  const GltfScene scene = valueOf(loadGltf(writtenGltf(planeGlb(), "scene.glb")));
  expectIsThePlane(*drawnIn(scene)[0].mesh);
}

TEST(GltfLoader, ReadsABufferBesideTheFile) {
  const std::filesystem::path folder = testFolder();
  const auto bytes = planeBuffer().bytes();
  std::ofstream(folder / "my buffer.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  test::writeText(folder / "scene.gltf", planeGltf(R"({"name":"base"})", "my%20buffer.bin"));
  expectIsThePlane(*drawnIn(valueOf(loadGltf(folder / "scene.gltf")))[0].mesh);
}

TEST(GltfLoader, ReadsIndicesAndTexcoordsOfEveryType) {
  const auto withIndices = [](const BufferBytes& buffer, const std::string& type, std::size_t bytes) {
    const std::string length = std::to_string(bytes);
    std::string text = planeGltf(R"({"name":"base"})", buffer.dataUri());
    text = replaced(text, R"("componentType":5123)", R"("componentType":)" + type);
    text =
        replaced(text, R"("byteOffset":128,"byteLength":12)", R"("byteOffset":128,"byteLength":)" + length);
    return replaced(text, R"("byteLength":140)", R"("byteLength":)" + std::to_string(buffer.bytes().size()));
  };
  const std::vector<std::uint8_t> all = planeBuffer().bytes();
  const std::vector<std::uint8_t> vertices(all.begin(), all.begin() + 128);
  {
    BufferBytes buffer;
    buffer.add(vertices).add<std::uint8_t>({0, 2, 3, 0, 3, 1});
    expectIsThePlane(*drawnIn(loadedText(withIndices(buffer, "5121", 6)))[0].mesh);
  }
  {
    BufferBytes buffer;
    buffer.add(vertices).add<std::uint32_t>({0, 2, 3, 0, 3, 1});
    expectIsThePlane(*drawnIn(loadedText(withIndices(buffer, "5125", 24)))[0].mesh);
  }
  const std::string floats = R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"})";
  {
    // 8-bit normalised, every vertex in four bytes.
    BufferBytes buffer;
    buffer.add(std::vector<std::uint8_t>(all.begin(), all.begin() + 96))
        .add<std::uint8_t>({0, 0, 9, 9, 255, 0, 9, 9, 0, 255, 9, 9, 255, 255, 9, 9})
        .add<std::uint8_t>(std::vector<std::uint8_t>(16))
        .add<std::uint16_t>({0, 2, 3, 0, 3, 1});
    std::string text = planeGltf(R"({"name":"base"})", buffer.dataUri());
    text = replaced(text, floats,
                    R"({"bufferView":2,"componentType":5121,"normalized":true,"count":4,"type":"VEC2"})");
    text = replaced(text, R"("byteLength":32)", R"("byteLength":32,"byteStride":4)");
    expectIsThePlane(*drawnIn(loadedText(text))[0].mesh);
  }
  {
    // 16-bit normalised, at an offset in its view.
    BufferBytes buffer;
    buffer.add(std::vector<std::uint8_t>(all.begin(), all.begin() + 96))
        .add<std::uint16_t>({7, 7, 0, 0, 65535, 0, 0, 65535, 65535, 65535, 7, 7, 7, 7, 7, 7})
        .add<std::uint16_t>({0, 2, 3, 0, 3, 1});
    std::string text = planeGltf(R"({"name":"base"})", buffer.dataUri());
    text = replaced(
        text, floats,
        R"({"bufferView":2,"byteOffset":4,"componentType":5123,"normalized":true,"count":4,"type":"VEC2"})");
    expectIsThePlane(*drawnIn(loadedText(text))[0].mesh);
  }
}

TEST(GltfLoader, ReadsTrianglesWithoutIndices) {
  std::string text = replaced(planeGltf(), R"("indices":3,)", "");
  for (int accessor = 0; accessor < 3; ++accessor) text = replaced(text, R"("count":4)", R"("count":3)");
  const auto meshes = drawnIn(loadedText(text));
  EXPECT_THAT(meshes[0].mesh->indices, ElementsAre(0u, 1u, 2u));
  EXPECT_EQ(meshes[0].mesh->positions.size(), 3u);
}

TEST(GltfLoader, MakesFlatNormalsWhereThereAreNone) {
  const auto meshes = drawnIn(loadedText(replaced(planeGltf(), R"("NORMAL":1,)", "")));
  EXPECT_EQ(meshes[0].mesh->positions.size(), 6u);
  for (const glm::vec3 normal : meshes[0].mesh->normals) EXPECT_EQ(normal, glm::vec3(0, 0, 1));
  for (const glm::vec4 tangent : meshes[0].mesh->tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, 1));
}

TEST(GltfLoader, KeepsTheTangentsOfTheFile) {
  const std::string text = replaced(replaced(planeGltf(), R"("NORMAL":1,)", R"("NORMAL":1,"TANGENT":4,)"),
                                    R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"})",
                                    R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"},)"
                                    R"({"bufferView":4,"componentType":5126,"count":4,"type":"VEC4"})");
  BufferBytes buffer = planeBuffer();
  buffer.add<std::uint16_t>({0, 0}).add<float>({0, 2, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1});
  const std::string whole = replaced(
      replaced(replaced(text, planeBuffer().dataUri(), buffer.dataUri()), R"("byteLength":140)",
               R"("byteLength":208)"),
      R"({"buffer":0,"byteOffset":128,"byteLength":12})",
      R"({"buffer":0,"byteOffset":128,"byteLength":12},{"buffer":0,"byteOffset":144,"byteLength":64})");
  const auto meshes = drawnIn(loadedText(whole));
  for (const glm::vec4 tangent : meshes[0].mesh->tangents) EXPECT_EQ(tangent, glm::vec4(0, 1, 0, -1));
}

TEST(GltfLoader, PlacesMeshesAndCamerasAsTheirNodesSay) {
  const std::string nodes =
      R"("nodes":[{"translation":[1,2,3],"rotation":[0,0.6,0,0.8],"scale":[2,1,0.5],"children":[1,2]},)"
      R"({"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,5,6,7,1],"mesh":0},)"
      R"({"translation":[0,0,9],"camera":0,"name":"place"}],"cameras":[{"type":"perspective","name":"eye",)"
      R"("perspective":{"yfov":0.5,"znear":0.1}}])";
  const GltfScene scene = loadedText(replaced(planeGltf(), R"("nodes":[{"mesh":0,"name":"plane"}])", nodes));

  const glm::dmat4 outer = glm::translate(glm::mat4(1), glm::vec3(1, 2, 3)) *
                           glm::mat4_cast(glm::quat(0.8f, 0.0f, 0.6f, 0.0f)) *
                           glm::scale(glm::mat4(1), glm::vec3(2, 1, 0.5f));
  const glm::dmat4 inner = glm::translate(glm::mat4(1), glm::vec3(5, 6, 7)) *
                           glm::rotate(glm::mat4(1), glm::radians(90.0f), glm::vec3(0, 0, 1));
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  const Camera& camera = scene.cameras[0].camera;
  const glm::vec3 eye(outer * glm::vec4(0, 0, 9, 1));
  const glm::dmat4 expectedView = glm::lookAt(eye, eye - glm::vec3(0.96f, 0, 0.28f), glm::vec3(0, 1, 0));
  const DrawnMesh placed = drawnIn(scene).at(0);
  for (const glm::vec3 position : placed.mesh->positions) {
    const glm::vec4 point(position, 1.0f);
    const glm::vec4 expected = camera.projection(1.5f) * expectedView * outer * inner * point;
    const glm::vec4 actual = camera.projection(1.5f) * camera.view * placed.toWorld * point;
    EXPECT_LT(glm::distance(actual, expected), 1e-4f);
  }
  EXPECT_EQ(camera.verticalFieldOfView, 0.5f);
  EXPECT_EQ(camera.nearPlane, 0.1f);
  EXPECT_GT(camera.farPlane, glm::distance(camera.position(), scene.bounds.center()));
}

TEST(GltfLoader, SharesTheMeshOfSeveralNodes) {
  const std::string text =
      replaced(replaced(planeGltf(), R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[0,1]}])"),
               R"({"mesh":0,"name":"plane"})", R"({"mesh":0},{"mesh":0,"translation":[0,0,1]})");
  const auto meshes = drawnIn(loadedText(text));
  ASSERT_EQ(meshes.size(), 2u);
  EXPECT_EQ(meshes[0].mesh, meshes[1].mesh);
}

std::string withLight(const std::string& light) {
  return replaced(replaced(planeGltf(), R"({"asset")",
                           R"({"extensions":{"KHR_lights_punctual":{"lights":[)" + light + R"(]}},"asset")"),
                  R"({"mesh":0,"name":"plane"})",
                  R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}})");
}

TEST(GltfLoader, ReadsLights) {
  const GltfScene point = loadedText(withLight(R"({"type":"point","color":[1,0.5,0.25],"intensity":8})"));
  EXPECT_EQ(point.lights, 1);
  ASSERT_TRUE(firstOf<PointLight>(*point.root));
  EXPECT_EQ(firstOf<PointLight>(*point.root)->intensity, glm::vec3(8, 4, 2));

  const GltfScene sun = loadedText(withLight(R"({"type":"directional","intensity":3})"));
  ASSERT_TRUE(firstOf<DirectionalLight>(*sun.root));
  EXPECT_EQ(firstOf<DirectionalLight>(*sun.root)->irradiance, glm::vec3(3));

  const GltfScene near = loadedText(withLight(R"({"type":"point","range":7.5})"));
  EXPECT_EQ(firstOf<PointLight>(*near.root)->range, 7.5f);

  const GltfScene spot = loadedText(withLight(
      R"({"type":"spot","intensity":2,"range":9,"spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}})"));
  ASSERT_TRUE(firstOf<SpotLight>(*spot.root));
  EXPECT_EQ(firstOf<SpotLight>(*spot.root)->intensity, glm::vec3(2));
  EXPECT_EQ(firstOf<SpotLight>(*spot.root)->innerAngle, 0.25f);
  EXPECT_EQ(firstOf<SpotLight>(*spot.root)->outerAngle, 0.5f);
  EXPECT_EQ(firstOf<SpotLight>(*spot.root)->range, 9.0f);
  EXPECT_FLOAT_EQ(firstOf<SpotLight>(*loadedText(withLight(R"({"type":"spot","spot":{}})")).root)->outerAngle,
                  0.25f * glm::pi<float>());
  EXPECT_THAT(
      failureOfText(withLight(R"({"type":"spot","spot":{"innerConeAngle":0.6,"outerConeAngle":0.5}})")),
      HasSubstr("light 0"));
  EXPECT_THAT(failureOfText(withLight(R"({"type":"area"})")), HasSubstr("light 0"));

  const GltfScene dark =
      loadedText(withLight(R"({"type":"point"})"), {.replacements = {}, .lights = false, .btf = {}});
  EXPECT_EQ(dark.lights, 0);
}

TEST(GltfLoader, MakesTheMaterialsThatTheFileNames) {
  const auto path = writtenGltf(planeGltf(
      R"({"name":"cloth","extensions":{"WEFT_materials_btf":{"uri":"wo%6fl.rf.exr","scale":[4,2]}}})"));
  test::requireDone(writeReflectanceField(test::testField(), path.parent_path() / "wool.rf.exr"));
  const GltfScene scene = valueOf(loadGltf(path));
  EXPECT_TRUE(dynamic_cast<const BTFMaterial*>(firstOf<MaterialGroup>(*scene.root)->material().get()));

  const GltfScene plain = loadedText(planeGltf());
  EXPECT_TRUE(dynamic_cast<const PBRMaterial*>(firstOf<MaterialGroup>(*plain.root)->material().get()));
}

TEST(GltfLoader, ReadsTheExampleOfTheExtensionsPage) {
  std::stringstream page;
  page << std::ifstream(test::sourceFolder() / "docs/gltf-extension.md").rdbuf();
  const std::string fence = "```json\n", text = page.str();
  const std::size_t start = text.find(fence);
  ASSERT_NE(start, std::string::npos);
  const std::size_t first = start + fence.size();
  const auto path = writtenGltf(text.substr(first, text.find("```", first) - first));
  test::requireDone(writeReflectanceField(test::testField(), path.parent_path() / "wool.rf.exr"));
  const GltfScene scene = valueOf(loadGltf(path));
  EXPECT_THAT(scene.materials, ElementsAre("wool"));
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_TRUE(dynamic_cast<const BTFMaterial*>(firstOf<MaterialGroup>(*scene.root)->material().get()));
  const auto meshes = drawnIn(scene);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].mesh->tangents, std::vector<glm::vec4>(3, {1, 0, 0, 1}));
}

constexpr const char* kTextured =
    R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
    R"("textures":[{"source":0}],"images":[{"uri":"colors.png"})";

TEST(GltfLoader, ReadsBaseColorTextures) {
  const auto path = writtenGltf(planeGltf(kTextured));
  test::requireDone(writePng(path.parent_path() / "colors.png", Image(3, 2, 3)));
  EXPECT_TRUE(loadGltf(path));
}

TEST(GltfLoader, WarnsOfAMissingOrBrokenTextureAndFallsBack) {
  const auto path = writtenGltf(planeGltf(kTextured));
  for (const char* message : {"colors.png: no such file", "colors.png: "}) {
    const GltfScene scene = valueOf(loadGltf(path));
    EXPECT_THAT(scene.warnings, ElementsAre(testing::AllOf(HasSubstr("base colour of material \"base\""),
                                                           HasSubstr(message))));
    test::writeText(path.parent_path() / "colors.png", "no picture");
  }
}

TEST(GltfLoader, ShowsTheMaterialsOwnMapsWhereAReflectanceFieldIsMissingOrBroken) {
  const auto path = writtenGltf(
      planeGltf(R"({"name":"cloth","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]},)"
                R"("extensions":{"WEFT_materials_btf":{"uri":"wool.rf.exr"}}})"));
  for (const bool broken : {false, true}) {
    if (broken) test::writeText(path.parent_path() / "wool.rf.exr", "this is no field");
    const GltfScene scene = valueOf(loadGltf(path));
    EXPECT_THAT(scene.warnings,
                ElementsAre(AllOf(HasSubstr("reflectance field of material \"cloth\""),
                                  HasSubstr(broken ? "wool.rf.exr: " : "wool.rf.exr: no such file"))));
    const auto* material =
        dynamic_cast<const PBRMaterial*>(firstOf<MaterialGroup>(*scene.root)->material().get());
    ASSERT_TRUE(material);
    EXPECT_EQ(material->options().baseColor, glm::vec4(0.5f, 0.25f, 0.125f, 1));
  }
}

TEST(GltfLoader, DoesNotReadWhatIsReplaced) {
  const auto path = writtenGltf(planeGltf(kTextured));
  const auto other = std::make_shared<LambertMaterial>();
  for (const char* name : {"base", "*"}) {
    GltfOptions options;
    options.replacements[name] = other;
    const GltfScene scene = valueOf(loadGltf(path, options));
    EXPECT_EQ(firstOf<MaterialGroup>(*scene.root)->material(), other);
    EXPECT_THAT(scene.materials, ElementsAre("base"));
  }
  GltfOptions options;
  options.replacements["another"] = other;
  EXPECT_NE(firstOf<MaterialGroup>(*valueOf(loadGltf(path, options)).root)->material(), other);
}

TEST(GltfLoader, IgnoresBrokenMaterialsThatNothingUses) {
  EXPECT_TRUE(loadGltf(writtenGltf(planeGltf(
      R"({"name":"base"},{"name":"unused","extensions":{"WEFT_materials_btf":{"uri":"none.rf.exr"}}})"))));
}

struct BrokenFile {
  std::string name;
  std::string from;
  std::string to;
  std::string message;

  friend void PrintTo(const BrokenFile& broken, std::ostream* stream) { *stream << broken.name; }
};

class BrokenGltf : public testing::TestWithParam<BrokenFile> {};

TEST_P(BrokenGltf, IsRefusedWithAReason) {
  const auto& [name, from, to, message] = GetParam();
  EXPECT_THAT(failureOfText(replaced(planeGltf(), from, to)),
              AllOf(HasSubstr("scene.gltf: "), HasSubstr(message)));
}

const char* const kMeshNode = R"({"mesh":0,"name":"plane"})";
const char* const kPositions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
const char* const kIndices = R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"})";

INSTANTIATE_TEST_SUITE_P(
    All, BrokenGltf,
    testing::Values(
        BrokenFile{"NotJson", R"({"asset")", R"(["asset")", "not valid glTF"},
        BrokenFile{"NestedTooDeeply", R"({"asset")",
                   R"({"extras":)" + std::string(100'000, '[') + R"(,"asset")", "nested too deeply"},
        BrokenFile{"NoScene", R"("scenes":[{"nodes":[0]}])", R"("scenes":[])", "no scene"},
        BrokenFile{"SceneOutOfRange", R"("scene":0)", R"("scene":3)", "default scene"},
        BrokenFile{"EmptyScene", R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[]}])",
                   "draws nothing"},
        BrokenFile{"RootOutOfRange", R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[7]}])", "node 7"},
        BrokenFile{"NegativeRoot", R"("scenes":[{"nodes":[0]}])", R"("scenes":[{"nodes":[-1]}])",
                   "/scenes/0/nodes/0 is -1"},
        BrokenFile{"NodeCycle", kMeshNode, R"({"mesh":0,"children":[1]},{"children":[0]})", "cycle"},
        BrokenFile{"NodeIsItsOwnChild", kMeshNode, R"({"mesh":0,"children":[0]})", "cycle"},
        BrokenFile{"ChildOutOfRange", kMeshNode, R"({"mesh":0,"children":[9]})", "node 9"},
        BrokenFile{"ShortMatrix", kMeshNode, R"({"mesh":0,"matrix":[1,0,0]})", "transform"},
        BrokenFile{"InfiniteTranslation", kMeshNode, R"({"mesh":0,"translation":[1e300,0,0]})", "transform"},
        BrokenFile{"InfiniteChild", kMeshNode,
                   R"({"scale":[1e30,1e30,1e30],"children":[1]},{"mesh":0,"scale":[1e30,1e30,1e30]})",
                   "transform"},
        BrokenFile{"FlatCamera", R"("nodes":[{"mesh":0,"name":"plane"}])",
                   R"("nodes":[{"mesh":0,"camera":0,"matrix":[1,0,0,0,1,0,0,0,0,0,1,0,0,0,0,1]}],)"
                   R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}])",
                   "camera 0"},
        BrokenFile{"HugeScene", kMeshNode, R"({"mesh":0,"scale":[1e38,1e38,1e38]})", "too large"},
        BrokenFile{"MeshOutOfRange", kMeshNode, R"({"mesh":4})", "mesh 4"},
        BrokenFile{"CameraOutOfRange", kMeshNode, R"({"mesh":0,"camera":2})", "camera 2"},
        BrokenFile{"LightOutOfRange", kMeshNode,
                   R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":1}}})", "light"},
        BrokenFile{"MaterialOutOfRange", R"("material":0)", R"("material":5)", "material 5"},
        BrokenFile{"AttributeOutOfRange", R"("POSITION":0)", R"("POSITION":11)", "accessor 11"},
        BrokenFile{"NegativeAttribute", R"("NORMAL":1)", R"("NORMAL":-3)",
                   "/meshes/0/primitives/0/attributes/NORMAL is -3"},
        BrokenFile{"WrongAttributeType", R"("POSITION":0)", R"("POSITION":2)", "components"},
        BrokenFile{"ShorterAttribute", R"("componentType":5126,"count":4,"type":"VEC2")",
                   R"("componentType":5126,"count":3,"type":"VEC2")", "differ in length"},
        BrokenFile{"IndicesOutOfRange", R"("indices":3)", R"("indices":12)", "out of bounds"},
        BrokenFile{"IndicesOfFloats", R"("indices":3)", R"("indices":0)", "components"},
        BrokenFile{"PartOfATriangle", kIndices,
                   R"({"bufferView":3,"componentType":5123,"count":5,"type":"SCALAR"})", "multiple of three"},
        BrokenFile{"AccessorBeyondItsView", kPositions,
                   R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})",
                   "beyond its buffer view"},
        BrokenFile{"HugeAccessor", kPositions,
                   R"({"bufferView":0,"componentType":5126,"count":9223372036854775807,"type":"VEC3"})",
                   "beyond its buffer view"},
        BrokenFile{"EmptyAccessor", kPositions,
                   R"({"bufferView":0,"componentType":5126,"count":0,"type":"VEC3"})", "empty"},
        BrokenFile{"OffsetBeyondTheView", kPositions,
                   R"({"bufferView":0,"byteOffset":4000,"componentType":5126,"count":1,"type":"VEC3"})",
                   "beyond its buffer view"},
        BrokenFile{"SparseAccessorBeyondItsCount", kPositions,
                   R"({"bufferView":0,"componentType":5126,"count":2,"type":"VEC3","sparse":{"count":3,)"
                   R"("indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}}})",
                   "replaces an element"},
        BrokenFile{
            "SparseIndicesBeyondTheirView", kPositions,
            R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":3,)"
            R"("indices":{"bufferView":3,"byteOffset":8,"componentType":5123},"values":{"bufferView":0}}})",
            "beyond its buffer view"},
        BrokenFile{"SparseAccessorWithoutAnEnd", kPositions,
                   R"({"componentType":5126,"count":9000000000,"type":"VEC3","sparse":{"count":1,)"
                   R"("indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}}})",
                   "too large"},
        BrokenFile{"NegativeSparseCount", kPositions,
                   R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":-1,)"
                   R"("indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}}})",
                   "/accessors/0/sparse/count is -1"},
        BrokenFile{"SparseIndicesOfFloats", kPositions,
                   R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,)"
                   R"("indices":{"bufferView":0,"componentType":5126},"values":{"bufferView":0}}})",
                   "unsigned integers"},
        BrokenFile{"ViewOutOfRange", kPositions,
                   R"({"bufferView":6,"componentType":5126,"count":4,"type":"VEC3"})", "buffer view 6"},
        BrokenFile{"ViewBeyondItsBuffer", R"("byteOffset":48,"byteLength":48)",
                   R"("byteOffset":48,"byteLength":4800)", "beyond its buffer"},
        BrokenFile{"ViewOfAnotherBuffer", R"({"buffer":0,"byteOffset":48)", R"({"buffer":1,"byteOffset":48)",
                   "buffer that does not exist"},
        BrokenFile{"ShortBuffer", R"("byteLength":140)", R"("byteLength":1400)", "not valid glTF"},
        BrokenFile{"RequiredExtension", R"({"asset")",
                   R"({"extensionsRequired":["KHR_texture_basisu"],"asset")", "KHR_texture_basisu"},
        BrokenFile{"BtfWithoutUri", R"({"name":"base"})",
                   R"({"name":"base","extensions":{"WEFT_materials_btf":{}}})",
                   "WEFT_materials_btf/uri is missing"},
        BrokenFile{"BtfOnNoTexcoords", R"({"name":"base"})",
                   R"({"name":"base","extensions":{"WEFT_materials_btf":{"uri":"x","texCoord":-1}}})",
                   "texCoord is -1"},
        BrokenFile{"BtfWithABrokenScale", R"({"name":"base"})",
                   R"({"name":"base","extensions":{"WEFT_materials_btf":{"uri":"x","scale":[0,1]}}})",
                   "scale"},
        BrokenFile{"BtfWithAMirroringScale", R"({"name":"base"})",
                   R"({"name":"base","extensions":{"WEFT_materials_btf":{"uri":"x","scale":[1,-1]}}})",
                   "scale"},
        BrokenFile{"AlphaModeOfAnotherFormat", R"({"name":"base"})",
                   R"({"name":"base","alphaMode":"DITHER"})", "DITHER"},
        BrokenFile{
            "BrokenTextureTransform", R"({"name":"base"})",
            R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
            R"({"KHR_texture_transform":{"offset":[1]}}}}}],"textures":[{"source":0}],"images":[{"uri":"x"})",
            "offset of KHR_texture_transform is not 2 numbers"},
        BrokenFile{"SamplerOutOfRange", R"({"name":"base"})",
                   R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                   R"("textures":[{"source":0,"sampler":2}],"images":[{"uri":"x"})",
                   "sampler 2"},
        BrokenFile{"SkinOutOfRange", kMeshNode, R"({"mesh":0,"skin":1})", "skin 1"},
        BrokenFile{"TextureOutOfRange", R"({"name":"base"})",
                   R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":3}}})", "texture 3"},
        BrokenFile{"ImageOutOfRange", R"({"name":"base"})",
                   R"({"name":"base","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                   R"("textures":[{"source":4})",
                   "image 4"}),
    [](const auto& broken) { return broken.param.name; });

TEST(GltfLoader, RefusesIndicesBeyondTheVertices) {
  BufferBytes buffer;
  buffer.add(std::vector<float>(32)).add<std::uint16_t>({0, 1, 2, 0, 2, 4});
  EXPECT_THAT(failureOfText(planeGltf(R"({"name":"base"})", buffer.dataUri())),
              HasSubstr("index 4, but only 4"));
}

TEST(GltfLoader, RefusesPositionsThatAreNotFinite) {
  std::vector<float> numbers(32);
  numbers[5] = std::nanf("");
  BufferBytes buffer;
  buffer.add(numbers).add<std::uint16_t>({0, 1, 2, 0, 2, 3});
  EXPECT_THAT(failureOfText(planeGltf(R"({"name":"base"})", buffer.dataUri())),
              HasSubstr("accessor 0 holds a value"));
}

TEST(GltfLoader, NamesAMissingFileAndAMissingBuffer) {
  const auto missing = loadGltf(testFolder() / "none.gltf");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr("none.gltf: no such file"));
  EXPECT_THAT(failureOfText(planeGltf(R"({"name":"base"})", "none.bin")),
              AllOf(HasSubstr("none.bin: no such file"), HasSubstr("/buffers/0 of scene.gltf")));
  EXPECT_FALSE(loadGltf(testFolder()));
}

TEST(GltfLoader, DoesNotLookForBuffersInTheWorkingDirectory) {
  const auto path = writtenGltf(planeGltf(R"({"name":"base"})", "stray.bin"));
  const auto folder = std::filesystem::current_path();
  std::filesystem::create_directory(path.parent_path() / "elsewhere");
  std::filesystem::current_path(path.parent_path() / "elsewhere");
  const auto bytes = planeBuffer().bytes();
  std::ofstream("stray.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_FALSE(loadGltf(path));
  std::filesystem::current_path(folder);
}

TEST(GltfLoader, RefusesEveryTruncationOfABinaryFile) {
  const std::string whole = planeGlb();
  const auto path = testFolder() / "scene.glb";
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::writeText(path, std::string_view(whole).substr(0, size));
    ASSERT_FALSE(loadGltf(path)) << size;
  }
}

TEST(GltfLoader, SurvivesDamage) {
  const std::string whole = planeGlb();
  const auto path = testFolder() / "scene.glb";
  std::mt19937 random(1);
  int survivors = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string damaged = whole;
    for (unsigned change = random() % 4; change < 4; ++change)
      damaged[random() % damaged.size()] = static_cast<char>(random() % 3 ? '0' + random() % 10 : random());
    test::writeText(path, damaged);
    if (loadGltf(path)) ++survivors;
  }
  EXPECT_GT(survivors, 0);
}

TEST(GltfLoader, ReadsSuzi) {
  WEFT_DATA_FILE(path, "gltf/suzi.glb");
  const GltfScene scene = valueOf(loadGltf(path));
  const auto meshes = drawnIn(scene);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].mesh->indices.size(), 47232u);
  EXPECT_NEAR(scene.bounds.maximum.x, 0.92973f, 1e-5f);
  EXPECT_NEAR(scene.bounds.minimum.y, -0.669795f, 1e-5f);
}

TEST(GltfLoader, ReadsFlightHelmetAndWarnsOfItsMissingTextures) {
  WEFT_DATA_FILE(path, "gltf/FlightHelmet/glTF/FlightHelmet.gltf");
  EXPECT_THAT(valueOf(loadGltf(path)).warnings,
              ElementsAre(HasSubstr("LeatherPartsMat_BaseColor.png"),
                          HasSubstr("LeatherPartsMat_OcclusionRoughMetal.png"),
                          HasSubstr("LeatherPartsMat_Normal.png")));
  GltfOptions options;
  options.replacements["LeatherPartsMat"] = std::make_shared<LambertMaterial>();
  const GltfScene scene = valueOf(loadGltf(path, options));
  EXPECT_EQ(drawnIn(scene).size(), 6u);
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_THAT(scene.materials, testing::Contains("HoseMat"));
}

TEST(GltfLoader, GeneratedTangentsAgreeWithFlightHelmetsOwn) {
  WEFT_DATA_FILE(path, "gltf/FlightHelmet/glTF/FlightHelmet.gltf");
  GltfOptions options;
  options.replacements["*"] = std::make_shared<LambertMaterial>();
  std::vector<float> angles;
  std::size_t mirrored = 0;
  for (const DrawnMesh& placed : drawnIn(valueOf(loadGltf(path, options)))) {
    const Mesh& own = *placed.mesh;
    Mesh generated = own;
    generateTangents(generated);
    for (std::size_t i = 0; i < own.indices.size(); ++i) {
      const glm::vec4 expected = own.tangents[own.indices[i]];
      const glm::vec4 actual = generated.tangents[generated.indices[i]];
      if (actual.w != expected.w) ++mirrored;
      const float cosine = glm::dot(glm::vec3(actual), glm::vec3(expected));
      angles.push_back(glm::degrees(std::acos(std::clamp(cosine, -1.0f, 1.0f))));
    }
  }
  std::sort(angles.begin(), angles.end());
  const float median = angles[angles.size() / 2];
  const float high = angles[angles.size() * 95 / 100];
  RecordProperty("median_degrees", std::to_string(median));
  RecordProperty("percentile_95_degrees", std::to_string(high));
  RecordProperty("other_handedness", std::to_string(mirrored));
  EXPECT_LT(median, 1.0f);
  EXPECT_LT(high, 5.0f);
  EXPECT_LT(static_cast<double>(mirrored), 0.01 * static_cast<double>(angles.size()));
}

}  // namespace
}  // namespace weft
