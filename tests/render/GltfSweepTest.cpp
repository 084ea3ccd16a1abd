// Valid files of every kind that the specification allows load; whatever is refused has a reason.

#include <gmock/gmock.h>

#include <functional>
#include <map>
#include <random>

#include "GltfScenes.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

using test::Json;
using testing::HasSubstr;

/// A file to which properties are added, one by one: four vertices, a node, a mesh, a material.
struct ValidFile {
  Json json =
      Json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
    "meshes":[{"primitives":[{"attributes":{}}]}],"materials":[{}],"accessors":[],"bufferViews":[],"buffers":[]})");
  test::BufferBytes bytes;

  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  Json& material() { return json["materials"][0]; }

  template <class Number>
  int addView(const std::vector<Number>& numbers) {
    while (bytes.bytes().size() % 4 != 0) bytes.add<std::uint8_t>({0});
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", bytes.bytes().size()},
                                   {"byteLength", numbers.size() * sizeof(Number)}});
    bytes.add(numbers);
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  /// Four elements of a type, each with its own stride: what is beyond the components is padding.
  int addAccessor(int componentType, int components, bool normalized, const std::vector<double>& values) {
    std::vector<std::uint8_t> all;
    const auto append = [&](auto number) {
      const auto* first = reinterpret_cast<const std::uint8_t*>(&number);
      all.insert(all.end(), first, first + sizeof number);
    };
    for (std::size_t i = 0; i < values.size(); ++i) {
      switch (componentType) {
        case 5120:
          append(static_cast<std::int8_t>(values[i] * (normalized ? 127 : 1)));
          break;
        case 5121:
          append(static_cast<std::uint8_t>(values[i] * (normalized ? 255 : 1)));
          break;
        case 5122:
          append(static_cast<std::int16_t>(values[i] * (normalized ? 32767 : 1)));
          break;
        case 5123:
          append(static_cast<std::uint16_t>(values[i] * (normalized ? 65535 : 1)));
          break;
        case 5125:
          append(static_cast<std::uint32_t>(values[i]));
          break;
        default:
          append(static_cast<float>(values[i]));
      }
      while ((i + 1) % static_cast<std::size_t>(components) == 0 && components > 1 && all.size() % 4 != 0)
        all.push_back(77);
    }
    const std::size_t count = values.size() / static_cast<std::size_t>(components);
    const int view = addView(all);
    if (components > 1) json["bufferViews"][view]["byteStride"] = all.size() / count;
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", componentType},
                                 {"count", count},
                                 {"type", components == 1    ? "SCALAR"
                                          : components == 16 ? "MAT4"
                                                             : "VEC" + std::to_string(components)}});
    if (normalized) json["accessors"].back()["normalized"] = true;
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  /// With the buffer embedded.
  std::string text() {
    if (!bytes.bytes().empty()) {
      json["buffers"] = Json::array({{{"byteLength", bytes.bytes().size()}, {"uri", bytes.dataUri()}}});
    }
    for (const char* key : {"accessors", "bufferViews", "buffers"})
      if (json[key].empty()) json.erase(key);
    return json.dump();
  }
};

using Property = std::function<void(ValidFile&)>;

const std::vector<double> kCorners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
const std::vector<double> kNormals{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
const std::vector<double> kTangents{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
const std::vector<double> kPairs{0, 0, 1, 0, 0, 1, 1, 1};
const std::vector<double> kQuads{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

/// Every type that an attribute may have (3.7.2.1, and KHR_mesh_quantization), alone in its list:
/// one of a list is chosen.
std::vector<std::vector<Property>> properties() {
  std::vector<std::vector<Property>> lists;
  const auto attribute = [](const char* name, int type, int components, bool normalized,
                            const std::vector<double>& values) -> Property {
    return [=](ValidFile& file) {
      file.primitive()["attributes"][name] = file.addAccessor(type, components, normalized, values);
    };
  };
  const auto typesOf = [&](const char* name, int components, const std::vector<double>& values,
                           std::vector<std::pair<int, bool>> types) {
    std::vector<Property> list;
    for (const auto& [type, normalized] : types)
      list.push_back(attribute(name, type, components, normalized, values));
    return list;
  };
  const std::vector<std::pair<int, bool>> units{{5126, false}, {5121, true}, {5123, true}};
  lists.push_back(typesOf("POSITION", 3, kCorners,
                          {{5126, false},
                           {5120, false},
                           {5120, true},
                           {5122, false},
                           {5122, true},
                           {5121, false},
                           {5123, true}}));
  lists.push_back(typesOf("NORMAL", 3, kNormals, {{5126, false}, {5120, true}, {5122, true}}));
  lists.push_back(typesOf("TANGENT", 4, kTangents, {{5126, false}, {5120, true}, {5122, true}}));
  lists.push_back(typesOf("TEXCOORD_0", 2, kPairs,
                          {{5126, false}, {5121, true}, {5123, true}, {5120, false}, {5122, true}}));
  lists.push_back(typesOf("TEXCOORD_1", 2, kPairs, units));
  lists.push_back(typesOf("COLOR_0", 3, kCorners, units));
  lists.push_back(typesOf("COLOR_0", 4, kQuads, units));
  lists.push_back(typesOf("_OWN", 1, {1, 2, 3, 4}, {{5126, false}, {5121, false}}));

  std::vector<Property> indices, modes;
  for (const int type : {5121, 5123, 5125})
    indices.push_back([=](ValidFile& file) {
      file.primitive()["indices"] = file.addAccessor(type, 1, false, {0, 1, 2, 1, 3, 2});
      file.primitive()["mode"] = 4;
    });
  for (const int mode : {0, 1, 2, 3, 5, 6})
    modes.push_back([=](ValidFile& file) { file.primitive()["mode"] = mode; });
  lists.push_back(indices);
  lists.push_back(modes);

  lists.push_back({[](ValidFile& file) {  // a skin, its joints below the node
                     for (const char* name : {"JOINTS_0", "WEIGHTS_0"})
                       file.primitive()["attributes"][name] =
                           file.addAccessor(std::string(name) == "JOINTS_0" ? 5121 : 5126, 4, false, kQuads);
                     const std::size_t first = file.json["nodes"].size();
                     file.json["nodes"].push_back(Json::object());
                     file.json["nodes"].push_back({{"translation", {0, 1, 0}}});
                     file.json["nodes"][0]["children"] = {first, first + 1};
                     file.json["nodes"][0]["skin"] = 0;
                     file.json["skins"] = Json::array({{{"joints", {first, first + 1}}}});
                   },
                   [](ValidFile& file) {  // instances
                     file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
                         {"TRANSLATION", file.addAccessor(5126, 3, false, kCorners)}};
                     file.json["extensionsRequired"].push_back("EXT_mesh_gpu_instancing");
                   }});
  std::vector<Property> morphs;
  for (const bool hasBytes : {false, true})
    morphs.push_back([=](ValidFile& file) {
      const int target = file.addAccessor(5126, 3, false, kCorners);
      if (!hasBytes) file.json["accessors"][target].erase("bufferView");
      file.primitive()["targets"] = {{{"POSITION", target}}, Json::object()};
      file.json["meshes"][0]["weights"] = {0.5, 1};
    });
  morphs.push_back([](ValidFile& file) {  // of no target: sparse values over zeros
    const int view = file.addView<std::uint8_t>({1}), values = file.addView<float>({0, 0, 1});
    file.json["accessors"].push_back(Json::parse(
        R"({"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,"indices":{"bufferView":)" +
        std::to_string(view) + R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) +
        "}}}"));
    file.primitive()["targets"] = {{{"POSITION", file.json["accessors"].size() - 1}}};
    file.json["nodes"][0]["weights"] = {1};
  });
  lists.push_back(morphs);

  std::vector<Property> animations;
  for (const char* path : {"translation", "rotation", "scale"})
    for (const char* interpolation : {"LINEAR", "STEP", "CUBICSPLINE", ""})
      animations.push_back([=](ValidFile& file) {
        const bool isSpline = std::string(interpolation) == "CUBICSPLINE";
        std::vector<double> values;
        for (int i = 0; i < (isSpline ? 6 : 2); ++i) values.insert(values.end(), {0.0, 0.0, 1.0});
        if (std::string(path) == "rotation") values.resize(isSpline ? 24 : 8, 1.0);
        const int output = file.addAccessor(5126, std::string(path) == "rotation" ? 4 : 3, false, values);
        const int input = file.addAccessor(5126, 1, false, {0.5, 2});
        Json sampler{{"input", input}, {"output", output}};
        if (*interpolation) sampler["interpolation"] = interpolation;
        file.json["animations"] =
            Json::array({{{"samplers", {sampler}},
                          {"channels",
                           {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}},
                            {{"sampler", 0}, {"target", {{"path", "an extension's"}}}}}}}});
      });
  lists.push_back(animations);

  const auto json = [](const char* place, const char* value) -> Property {
    return [=](ValidFile& file) { file.json[Json::json_pointer(place)] = Json::parse(value); };
  };
  lists.push_back({json("/nodes/0/matrix", "[2,0,0,0,0,2,0,0,0,0,2,0,1,2,3,1]"),
                   json("/nodes/0/translation", "[1,2,3]"), json("/nodes/0/rotation", "[0,0,0,1]"),
                   json("/nodes/0/scale", "[1,-1,1]")});
  lists.push_back({json("/cameras/0", R"({"type":"perspective","perspective":{"yfov":1,"znear":0.1}})"),
                   json("/cameras/0", R"({"type":"perspective","perspective":{"yfov":1,"znear":0.1,"zfar":9,
                     "aspectRatio":1.5}})"),
                   json("/cameras/0", R"({"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0,
                     "zfar":9}})")});
  for (const char* light : {R"({"type":"directional"})", R"({"type":"point","range":5})",
                            R"({"type":"spot","spot":{},"color":[1,0.5,0],"intensity":3,"name":"l"})",
                            R"({"type":"spot","spot":{"innerConeAngle":0,"outerConeAngle":1.5707963}})"})
    lists.push_back({[=](ValidFile& file) {
      file.json["extensions"]["KHR_lights_punctual"]["lights"] = {Json::parse(light)};
      file.json["nodes"][0]["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
      file.json["extensionsRequired"].push_back("KHR_lights_punctual");
    }});
  lists.push_back({json("/materials/0/alphaMode", "\"MASK\""), json("/materials/0/alphaMode", "\"BLEND\"")});
  lists.push_back(
      {json("/materials/0/pbrMetallicRoughness", "{}"),
       json("/materials/0/pbrMetallicRoughness", R"({"metallicFactor":0,"baseColorFactor":[1,1,1,0]})")});
  std::vector<Property> extensions;
  for (const char* name : {"KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
                           "KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness"})
    extensions.push_back([=](ValidFile& file) {
      file.material()["extensions"][name] = Json::object();
      file.json["extensionsRequired"].push_back(name);
    });
  lists.push_back(extensions);
  std::vector<Property> textures;
  for (const int filter : {9728, 9729, 9984, 9985, 9986, 9987})
    for (const int wrap : {33071, 33648, 10497})
      textures.push_back([=](ValidFile& file) {
        const auto png = *encodePng(Image(2, 2, filter % 4 + 1));
        Json& image = file.json["images"][0];
        if (wrap == 33071) {
          image = {{"bufferView", file.addView(png)}, {"mimeType", "image/png"}};
        } else {
          test::BufferBytes embedded;
          embedded.add(png);
          image = {{"uri", embedded.dataUri()}};
        }
        file.json["samplers"] = Json::array({{{"minFilter", filter},
                                              {"magFilter", filter < 9984 ? filter : 9729},
                                              {"wrapS", wrap},
                                              {"wrapT", wrap}},
                                             Json::object()});
        file.json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}, {{"source", 0}}});
        file.material()["normalTexture"] = {{"index", 1}};
        file.material()["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
        file.material()["pbrMetallicRoughness"]["baseColorTexture"] =
            Json::parse(R"({"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,0.5]}}})");
      });
  lists.push_back(textures);
  lists.push_back({json("/nodes/0/name", R"("\u0000 \ud83e\uddf6 \"\\")"),
                   json("/asset/generator", "\"none\""), json("/asset/copyright", "\"\"")});
  lists.push_back({json("/extras", "7"), json("/nodes/0/extras", "[[],{},null]"),
                   json("/meshes/0/primitives/0/extras", R"({"targetNames":["a"]})")});
  lists.push_back({json("/extensions/ACME_door", "{}"), json("/materials/0/extensions/ACME_paint", "[1]"),
                   json("/nodes/0/extensions/ACME_hinge", R"({"nodes":"none"})")});
  return lists;
}

void expectLoads(ValidFile& file, const std::string& what) {
  file.json["extensionsUsed"] = {"KHR_mesh_quantization", "KHR_texture_transform"};
  if (file.json.contains("extensionsRequired"))
    for (const Json& name : Json(file.json["extensionsRequired"]))
      file.json["extensionsUsed"].push_back(name);
  const auto scene = loadGltf(test::writtenGltf(file.text()), {.time = 1.0});
  // An animation may scale all to nothing.
  if (!scene && scene.error().message().ends_with("the scene draws nothing")) {
    EXPECT_TRUE(file.json.contains("animations")) << what;
  } else if (file.json.contains("animations")) {
    EXPECT_TRUE(scene) << what << ": " << scene.error().message() << '\n' << file.json;
  } else {
    EXPECT_TRUE(loadGltf(test::writtenGltf(file.text()))) << what;
  }
}

/// Whether a property is there that does not go with another: a strip has other vertices than
/// indices say.
void finish(ValidFile& file) {
  Json& primitive = file.primitive();
  if (!primitive["attributes"].contains("POSITION"))
    primitive["attributes"]["POSITION"] = file.addAccessor(5126, 3, false, kCorners);
  const int mode = primitive.value("mode", 4);
  if (mode == 4 && !primitive.contains("indices"))
    primitive["indices"] = file.addAccessor(5121, 1, false, {0, 1, 2, 1, 3, 2});
  if (primitive["attributes"].contains("TANGENT") && !primitive["attributes"].contains("NORMAL"))
    primitive["attributes"].erase("TANGENT");
  if (file.json["nodes"][0].contains("matrix")) {
    for (const char* key : {"translation", "rotation", "scale"}) file.json["nodes"][0].erase(key);
    if (file.json.contains("animations")) file.json["nodes"][0].erase("matrix");
  }
  if (file.json.contains("cameras")) {
    file.json["nodes"].push_back({{"camera", 0}});
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size() - 1);
  }
}

TEST(GltfSweep, EveryPropertyAloneLoads) {
  const auto lists = properties();
  int files = 0;
  for (std::size_t list = 0; list < lists.size(); ++list)
    for (std::size_t i = 0; i < lists[list].size(); ++i, ++files) {
      ValidFile file;
      lists[list][i](file);
      finish(file);
      expectLoads(file, "property " + std::to_string(list) + ", " + std::to_string(i));
    }
  EXPECT_GT(files, 90);
}

TEST(GltfSweep, PropertiesTogetherLoad) {
  const auto lists = properties();
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    ValidFile file;
    std::string what;
    for (std::size_t list = 0; list < lists.size(); ++list) {
      if (random() % 3 == 0) continue;
      const std::size_t i = random() % lists[list].size();
      what += std::to_string(list) + "." + std::to_string(i) + " ";
      lists[list][i](file);
    }
    finish(file);
    expectLoads(file, what);
  }
}

TEST(GltfSweep, ABinaryFileMayHaveChunksOfOthersAndNone) {
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  const auto chunk = [&](const std::string& kind, std::string content) {
    content.resize((content.size() + 3) / 4 * 4, ' ');
    return word(content.size()) + kind + content;
  };
  const auto file = [&](const std::string& chunks) {
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
  };
  const auto loads = [](const std::string& bytes) {
    const auto scene = loadGltf(test::writtenGltf(bytes, "scene.glb"));
    return scene ? std::string() : scene.error().message();
  };
  const std::string embedded = chunk("JSON", test::triangleGltf().dump());
  EXPECT_EQ(loads(file(embedded)), "");
  EXPECT_EQ(loads(file(embedded + chunk("ACME", "anything"))), "");
  Json json = test::triangleGltf();
  json["buffers"][0].erase("uri");
  EXPECT_THAT(loads(file(chunk("JSON", json.dump()))), HasSubstr("/buffers/0"));
  const std::string floats(
      reinterpret_cast<const char*>(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}.data()), 36);
  EXPECT_EQ(loads(file(chunk("JSON", json.dump()) + chunk(std::string("BIN\0", 4), floats))), "");
  EXPECT_EQ(loads(file(chunk("JSON", json.dump()) + chunk(std::string("BIN\0", 4), floats)) + "more"), "")
      << "what follows the file";
  EXPECT_THAT(loads("glTF" + word(1) + word(20) + word(0) + word(0)), HasSubstr("not glTF 2.0"));
}

TEST(GltfSweep, LoadsOrRefusesEveryFileOfAssimpsTestModels) {
  const std::filesystem::path folder = "/usr/share/assimp/models";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "install assimp-testmodels to test with its files";
  // What is wrong with the broken ones, by a part of their path.
  const std::map<std::string, std::string> refusals{
      {"/glTF/", "glTF"},
      {"BoxTextured-glTF-techniqueWebGL", "KHR_technique_webgl"},
      {"SceneWithoutNodes", "draws nothing"},
      {"NoScene", "no scene"},
      {"sceneWrongType", "/scene is"},
      {"IncorrectVertexArrays", "multiple of three"},
      {"IndexOutOfRange", "has index"},
      {"badNumber", "/materials/0/normalTexture/index"},
      {"badExtension", "KHR_texture_transform is"},
      {"badObject", "/materials/0/pbrMetallicRoughness is"},
      {"badUint", "/baseColorTexture/index is"},
      {"badArray", "/meshes/0/primitives is"},
      {"badString", "/scenes/0/name is"},
      {"BoxWithInfinites", "not finite"},
      {"RecursiveNodes", "cycle"},
#ifndef WEFT_DRACO
      {"/draco/", "KHR_draco_mesh_compression"},
#endif
      {"MissingBin", "BoxTextured0.bin: no such file"}};
  int loaded = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (!path.ends_with(".gltf") && !path.ends_with(".glb")) continue;
    const auto refusal = std::find_if(refusals.begin(), refusals.end(), [&](const auto& pair) {
      return path.find(pair.first) != std::string::npos;
    });
    const auto scene = loadGltf(entry.path());
    loaded += scene.has_value();
    if (scene) {
      EXPECT_EQ(refusal, refusals.end()) << path;
    } else {
      ASSERT_NE(refusal, refusals.end()) << scene.error().message();
      EXPECT_THAT(scene.error().message(), HasSubstr(refusal->second));
    }
  }
  RecordProperty("loaded", loaded);
  EXPECT_GT(loaded, 25);
}

}  // namespace
}  // namespace weft
