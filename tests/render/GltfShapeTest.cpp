// Members of another type than glTF says, which parsers like to skip.

#include <gmock/gmock.h>

#include <functional>

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

/// A file that has every member that Weft reads; it need not be drawn well. Numbers without a point
/// must be whole.
Json fullFile() {
  test::GltfText text;
  text.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  text.add<float>({0, 0, 0, 0, 0, 0}, "VEC2");
  text.add<float>({0, 1}, "SCALAR");
  text.add<float>({0, 0, 0, 1, 0, 0}, "VEC3");
  text.add<std::uint16_t>({0, 1, 2}, "SCALAR");
  Json file = Json::parse(text.text(R"("nodes":[])"));
  file.merge_patch(Json::parse(R"({
    "asset": {"version": "2.0", "minVersion": "2.0"},
    "scenes": [{"name": "all", "nodes": [0, 1]}],
    "nodes": [
      {"name": "a", "mesh": 0, "camera": 0, "children": [2], "weights": [0.5],
       "translation": [0.0, 0.0, 0.0], "rotation": [0.0, 0.0, 0.0, 1.0], "scale": [1.0, 1.0, 1.0],
       "extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"mesh": 0, "matrix": [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
       "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 3}}}},
      {"mesh": 0, "skin": 0, "camera": 1}],
    "meshes": [{"name": "m", "weights": [0.5], "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
      "indices": 4, "material": 0, "mode": 4, "targets": [{"POSITION": 0}]}]}],
    "skins": [{"name": "s", "joints": [0], "skeleton": 0}],
    "cameras": [
      {"name": "p", "type": "perspective", "perspective": {"yfov": 1.0, "znear": 1.0, "zfar": 9.0, "aspectRatio": 1.0}},
      {"type": "orthographic", "orthographic": {"xmag": 1.0, "ymag": 1.0, "znear": 1.0, "zfar": 9.0}}],
    "materials": [
      {"name": "m", "alphaMode": "MASK", "alphaCutoff": 0.5, "doubleSided": true, "emissiveFactor": [1.0, 1.0, 1.0],
       "pbrMetallicRoughness": {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "metallicFactor": 1.0, "roughnessFactor": 1.0,
         "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
           {"offset": [0.0, 0.0], "rotation": 0.0, "scale": [1.0, 1.0], "texCoord": 0}}},
         "metallicRoughnessTexture": {"index": 0}},
       "normalTexture": {"index": 0, "scale": 1.0}, "occlusionTexture": {"index": 0, "strength": 1.0},
       "emissiveTexture": {"index": 0},
       "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1.0}, "KHR_materials_ior": {"ior": 1.5},
         "KHR_materials_specular": {"specularFactor": 1.0, "specularColorFactor": [1.0, 1.0, 1.0],
           "specularTexture": {"index": 0}, "specularColorTexture": {"index": 0}}, "KHR_materials_unlit": {}}},
      {"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [1.0, 1.0, 1.0, 1.0],
        "specularFactor": [1.0, 1.0, 1.0], "glossinessFactor": 1.0, "diffuseTexture": {"index": 0},
        "specularGlossinessTexture": {"index": 0}}}},
      {"extensions": {"WEFT_materials_btf": {"uri": "a.rf.exr", "scale": [1.0, 1.0], "texCoord": 0}}}],
    "textures": [{"name": "t", "sampler": 0, "source": 0}],
    "images": [{"name": "i", "uri": "none.png", "mimeType": "image/png"}, {"bufferView": 0}],
    "samplers": [{"name": "s", "magFilter": 9729, "minFilter": 9729, "wrapS": 10497, "wrapT": 10497}],
    "animations": [{"name": "a", "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
      "samplers": [{"input": 2, "output": 3, "interpolation": "LINEAR"}]}],
    "extensionsUsed": ["KHR_lights_punctual", "EXT_mesh_gpu_instancing"], "extensionsRequired": [],
    "extensions": {"KHR_lights_punctual": {"lights": [{"name": "l", "type": "spot", "color": [1.0, 1.0, 1.0],
      "intensity": 1.0, "range": 9.0, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}}]}}
  })"));
  file["accessors"][0].update(Json::parse(R"({"name": "x", "byteOffset": 0, "normalized": false,
    "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 0.0], "sparse": {"count": 1, "indices":
    {"bufferView": 4, "byteOffset": 0, "componentType": 5123}, "values": {"bufferView": 0, "byteOffset": 0}}})"));
  file["bufferViews"][0].update(Json::parse(R"({"name": "v", "byteStride": 12, "target": 34962})"));
  file["buffers"][0]["name"] = "b";
  return file;
}

/// Calls with the place of every value.
void visit(const Json& value, const Json::json_pointer& place,
           const std::function<void(const Json::json_pointer&, const Json&)>& call) {
  if (!place.empty()) call(place, value);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) visit(value[i], place / i, call);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) visit(member, place / key, call);
}

TEST(GltfShape, TheFileThatHasEverythingLoads) {
  const GltfScene scene = loadedGltf(fullFile(), {.time = 0.5});
  EXPECT_EQ(scene.cameras.size(), 2u);
  EXPECT_EQ(scene.animations.size(), 1u);
}

TEST(GltfShape, EveryMemberOfAnotherTypeIsRefusedByItsPlace) {
  const Json file = fullFile();
  int members = 0;
  visit(file, Json::json_pointer(), [&](const Json::json_pointer& place, const Json& value) {
    for (const Json& other : {Json(-1.5), Json("48"), Json::array({Json::object()})}) {
      const bool isSame = other.is_number() ? value.is_number_float() : other.type() == value.type();
      if (isSame || (other.is_number() && place.to_string() == "/asset/version")) continue;
      Json damaged = file;
      damaged[place] = other;
      EXPECT_THAT(failureOfGltf(damaged), AllOf(HasSubstr("scene.gltf: "), HasSubstr(place.to_string())))
          << other;
    }
    ++members;
  });
  EXPECT_GT(members, 250);
}

TEST(GltfShape, WholeNumbersAreReadInAnyNotation) {
  const Json file = fullFile();
  const std::vector<test::DrawnMesh> expected = drawnIn(loadedGltf(file, {.time = 0.5}));
  ASSERT_EQ(expected.size(), 4u);
  int numbers = 0;
  visit(file, Json::json_pointer(), [&](const Json::json_pointer& place, const Json& value) {
    if (!value.is_number_integer()) return;
    Json other = file;
    other[place] = value.get<double>();
    const auto drawn = drawnIn(loadedGltf(other, {.time = 0.5}));
    ASSERT_EQ(drawn.size(), expected.size()) << place;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      EXPECT_EQ(drawn[i].mesh->positions, expected[i].mesh->positions) << place;
      EXPECT_EQ(drawn[i].toWorld, expected[i].toWorld) << place;
    }
    ++numbers;
  });
  EXPECT_GT(numbers, 80);
}

TEST(GltfShape, NumbersThatAreNotWholeOrTooLargeAreRefused) {
  for (const Json& wrong : {Json(0.5), Json(-4), Json(-4.0), Json(1e300), Json(18446744073709551615u)}) {
    Json file = fullFile();
    file["accessors"][1]["byteOffset"] = wrong;
    EXPECT_THAT(failureOfGltf(file), HasSubstr("/accessors/1/byteOffset is " + wrong.dump()));
  }
}

TEST(GltfShape, WhatMustBeThereIsMissedByItsPlace) {
  for (const char* place : {"/asset/version", "/accessors/0/count", "/meshes/0/primitives/0/attributes",
                            "/cameras/0/perspective/yfov", "/textures", "/skins/0/joints"}) {
    const Json::json_pointer pointer(place);
    Json file = fullFile();
    file[pointer.parent_pointer()].erase(pointer.back());
    const auto text = failureOfGltf(file);
    if (pointer.back() == "textures")
      EXPECT_THAT(text, HasSubstr("texture 0 does not exist"));
    else
      EXPECT_THAT(text, HasSubstr(std::string(place) + " is missing"));
  }
}

TEST(GltfShape, ANullCountsAsMissingAndIsSaid) {
  Json file = test::triangleGltf();
  file["nodes"][0]["camera"] = nullptr;
  file["meshes"][0]["primitives"][0]["material"] = nullptr;
  EXPECT_THAT(loadedGltf(file).warnings,
              testing::ElementsAre(AllOf(HasSubstr("/nodes/0/camera is null"), HasSubstr("1 more"))));
  file["meshes"][0]["primitives"][0]["attributes"] = nullptr;
  EXPECT_THAT(failureOfGltf(file), HasSubstr("/meshes/0/primitives/0/attributes is missing"));
}

TEST(GltfShape, WhatWeftDoesNotReadIsNotLookedAt) {
  Json file = test::triangleGltf();
  file["extras"] = {{"nodes", 7}};
  file["ACME"] = {1, "two"};
  file["nodes"][0]["extensions"]["ACME_door"] = 5;
  file["nodes"][0]["ACME"] = false;
  EXPECT_THAT(loadedGltf(file).warnings, IsEmpty());
}

TEST(GltfShape, VersionsThatNeedMoreThanGltf20AreRefused) {
  const auto with = [](const Json& asset) {
    Json file = test::triangleGltf();
    file["asset"] = asset;
    return failureOfGltf(file);
  };
  EXPECT_EQ(with({{"version", "2.0"}, {"minVersion", "2.0"}}), "it loaded");
  EXPECT_EQ(with({{"version", "2.1"}}), "it loaded") << "a later one is compatible unless it says otherwise";
  EXPECT_THAT(with({{"version", "2.1"}, {"minVersion", "2.1"}}), HasSubstr("minVersion"));
  EXPECT_THAT(with({{"version", "3.0"}}), HasSubstr("glTF 3.0"));
  EXPECT_THAT(with({{"version", "1.0"}}), HasSubstr("glTF 1.0"));
  EXPECT_THAT(with({{"version", 1}}), HasSubstr("glTF 1"));
  EXPECT_THAT(with({{"generator", "none"}}), HasSubstr("/asset/version is missing"));
}

TEST(GltfShape, BrokenJsonIsRefusedWithItsPlaceAndNoneOfItsBytes) {
  const auto failureOf = [](std::string_view text) {
    const auto scene = loadGltf(test::writtenGltf(text));
    return scene ? std::string("it loaded") : scene.error().message();
  };
  EXPECT_THAT(failureOf("{\"asset\": \x1b[31m}"), AllOf(HasSubstr("byte 11"), Not(HasSubstr("\x1b"))));
  EXPECT_THAT(failureOf(R"({"asset":{"version":"2.0"},"scene":1e999})"), HasSubstr("beyond all bounds"));
  EXPECT_THAT(failureOf("PK\x03\x04 and so on"), HasSubstr("this is a zip"));
  EXPECT_THAT(failureOf("\x89PNG\r\n\x1a\n"), HasSubstr("this is a PNG image"));
  EXPECT_THAT(failureOf(""), HasSubstr("valid glTF"));
}

}  // namespace
}  // namespace weft
