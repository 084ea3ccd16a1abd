#include "GltfShape.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

// As files are built: an object has these members, those with "!" always; an array these elements;
// "*" stands for members of any name. "index" is a whole number of an int, "size" any; other words
// are types, or objects that are described once. What is not listed is not looked at.
constexpr const char* kShapes = R"({
"file": {
  "asset!": {"version!": "string", "minVersion": "string"},
  "scene": "index",
  "scenes": [{"name": "string", "nodes": ["index"]}],
  "nodes": [{
    "name": "string", "camera": "index", "children": ["index"], "skin": "index", "mesh": "index",
    "matrix": ["number"], "rotation": ["number"], "scale": ["number"], "translation": ["number"],
    "weights": ["number"],
    "extensions": {
      "KHR_lights_punctual": {"light!": "index"},
      "EXT_mesh_gpu_instancing": {"attributes!": {"*": "index"}}
    }
  }],
  "meshes": [{
    "name": "string", "weights": ["number"],
    "primitives!": [{
      "attributes!": {"*": "index"}, "indices": "index", "material": "index", "mode": "index",
      "targets": [{"*": "index"}],
      "extensions": {"KHR_draco_mesh_compression": {"bufferView!": "index", "attributes!": {"*": "index"}}}
    }]
  }],
  "skins": [{"name": "string", "joints!": ["index"], "inverseBindMatrices": "index", "skeleton": "index"}],
  "cameras": [{
    "name": "string", "type!": "string",
    "perspective": {"yfov!": "number", "znear!": "number", "zfar": "number", "aspectRatio": "number"},
    "orthographic": {"xmag!": "number", "ymag!": "number", "znear!": "number", "zfar!": "number"}
  }],
  "materials": [{
    "name": "string", "alphaMode": "string", "alphaCutoff": "number", "doubleSided": "boolean",
    "emissiveFactor": ["number"],
    "pbrMetallicRoughness": {
      "baseColorFactor": ["number"], "metallicFactor": "number", "roughnessFactor": "number",
      "baseColorTexture": "texture", "metallicRoughnessTexture": "texture"
    },
    "normalTexture": "texture", "occlusionTexture": "texture", "emissiveTexture": "texture",
    "extensions": {
      "KHR_materials_emissive_strength": {"emissiveStrength": "number"},
      "KHR_materials_ior": {"ior": "number"},
      "KHR_materials_specular": {
        "specularFactor": "number", "specularColorFactor": ["number"],
        "specularTexture": "texture", "specularColorTexture": "texture"
      },
      "KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": ["number"], "specularFactor": ["number"], "glossinessFactor": "number",
        "diffuseTexture": "texture", "specularGlossinessTexture": "texture"
      },
      "KHR_materials_clearcoat": {
        "clearcoatFactor": "number", "clearcoatRoughnessFactor": "number",
        "clearcoatTexture": "texture", "clearcoatRoughnessTexture": "texture",
        "clearcoatNormalTexture": "texture"
      },
      "KHR_materials_sheen": {
        "sheenColorFactor": ["number"], "sheenRoughnessFactor": "number",
        "sheenColorTexture": "texture", "sheenRoughnessTexture": "texture"
      },
      "KHR_materials_anisotropy": {
        "anisotropyStrength": "number", "anisotropyRotation": "number", "anisotropyTexture": "texture"
      },
      "KHR_materials_iridescence": {
        "iridescenceFactor": "number", "iridescenceIor": "number",
        "iridescenceThicknessMinimum": "number", "iridescenceThicknessMaximum": "number",
        "iridescenceTexture": "texture", "iridescenceThicknessTexture": "texture"
      },
      "KHR_materials_transmission": {"transmissionFactor": "number", "transmissionTexture": "texture"},
      "KHR_materials_unlit": {},
      "WEFT_materials_btf": {
        "uri!": "string", "map": "string", "tiling": "string", "scale": ["number"], "texCoord": "index",
        "extensions": {"KHR_texture_transform": "transform"}
      }
    }
  }],
  "textures": [{"name": "string", "sampler": "index", "source": "index"}],
  "images": [{"name": "string", "uri": "string", "mimeType": "string", "bufferView": "index"}],
  "samplers": [{
    "name": "string", "magFilter": "index", "minFilter": "index", "wrapS": "index", "wrapT": "index"
  }],
  "animations": [{
    "name": "string",
    "channels!": [{"sampler!": "index", "target!": {"node": "index", "path!": "string"}}],
    "samplers!": [{"input!": "index", "output!": "index", "interpolation": "string"}]
  }],
  "accessors": [{
    "name": "string", "bufferView": "index", "byteOffset": "size", "componentType!": "index",
    "normalized": "boolean", "count!": "size", "type!": "string", "min": ["number"], "max": ["number"],
    "sparse": {
      "count!": "index",
      "indices!": {"bufferView!": "index", "byteOffset": "index", "componentType!": "index"},
      "values!": {"bufferView!": "index", "byteOffset": "index"}
    }
  }],
  "bufferViews": [{
    "name": "string", "buffer!": "index", "byteOffset": "size", "byteLength!": "size", "byteStride": "size",
    "target": "index",
    "extensions": {
      "EXT_meshopt_compression": {
        "buffer!": "index", "byteOffset": "index", "byteLength!": "index", "byteStride!": "index",
        "count!": "index", "mode!": "string", "filter": "string"
      }
    }
  }],
  "buffers": [{
    "name": "string", "uri": "string", "byteLength!": "size",
    "extensions": {"EXT_meshopt_compression": {"fallback": "boolean"}}
  }],
  "extensionsUsed": ["string"],
  "extensionsRequired": ["string"],
  "extensions": {
    "KHR_lights_punctual": {
      "lights!": [{
        "name": "string", "type!": "string", "color": ["number"], "intensity": "number", "range": "number",
        "spot": {"innerConeAngle": "number", "outerConeAngle": "number"}
      }]
    }
  }
},
"texture": {
  "index!": "index", "texCoord": "index", "scale": "number", "strength": "number",
  "extensions": {"KHR_texture_transform": "transform"}
},
"transform": {"offset": ["number"], "rotation": "number", "scale": ["number"], "texCoord": "index"}
})";

/// A value as a message quotes it.
std::string quoted(const Json& value) {
  constexpr std::size_t kLongest = 40;
  if (value.is_array()) return "an array";
  if (value.is_object()) return "an object";
  std::string text = value.dump(-1, ' ', true);
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

/// A number as a whole one from 0 to `largest`.
std::optional<std::int64_t> wholeNumber(const Json& value, std::int64_t largest) {
  // 2^53: beyond, a double is no longer one whole number
  constexpr double kTooLarge = 9007199254740992.0;
  std::optional<std::int64_t> whole;
  if (value.is_number_float()) {
    const double number = value.get<double>();
    if (number == std::floor(number) && number >= 0.0 && number < kTooLarge)
      whole = static_cast<std::int64_t>(number);
  } else if (value.is_number_integer()) {
    whole = value.get<std::int64_t>();  // beyond its range negative
  }
  return whole && *whole >= 0 && *whole <= largest ? whole : std::nullopt;
}

class ShapeCheck {
 public:
  ShapeCheck(const std::filesystem::path& path, std::vector<std::string>& warnings)
      : shapes_(Json::parse(kShapes)), path_(path), warnings_(warnings) {}

  Result<void> check(Json& file) {
    WEFT_TRY_VOID(check(file, shapes_["file"], ""));
    if (nulls_ > 0)
      warnings_.push_back(firstNull_ + " is null, and counts as not there" +
                          (nulls_ > 1 ? ", as " + std::to_string(nulls_ - 1) + " more" : ""));
    return {};
  }

 private:
  Result<void> check(Json& value, const Json& shape, const std::string& place) {
    if (shape.is_object()) return checkObject(value, shape, place);
    if (shape.is_array()) return checkArray(value, shape[0], place);
    const auto& type = shape.get_ref<const std::string&>();
    if (const auto described = shapes_.find(type); described != shapes_.end())
      return check(value, *described, place);
    if (type == "index") return checkWhole(value, std::numeric_limits<std::int32_t>::max(), place);
    if (type == "size") return checkWhole(value, std::numeric_limits<std::int64_t>::max(), place);
    const bool fits = type == "string"    ? value.is_string()
                      : type == "boolean" ? value.is_boolean()
                                          : value.is_number();
    return fits ? Result<void>() : otherType(value, place, "a " + type);
  }

  Result<void> checkObject(Json& value, const Json& shape, const std::string& place) {
    if (!value.is_object()) return otherType(value, place, "an object");
    for (const auto& [key, member] : shape.items()) {
      const bool required = key.ends_with('!');
      const std::string name = required ? key.substr(0, key.size() - 1) : key;
      if (name == "*")
        WEFT_TRY_VOID(checkAll(value, member, place));
      else
        WEFT_TRY_VOID(checkMember(value, name, member, required, place));
    }
    return {};
  }

  Result<void> checkMember(Json& object, const std::string& name, const Json& shape, bool required,
                           const std::string& place) {
    auto found = object.find(name);
    if (found != object.end() && found->is_null()) {
      if (nulls_++ == 0) firstNull_ = place + "/" + name;
      object.erase(found);
      found = object.end();
    }
    if (found != object.end()) return check(*found, shape, place + "/" + name);
    return required ? fail(place + "/" + name + " is missing", path_.string()) : Result<void>();
  }

  Result<void> checkAll(Json& object, const Json& shape, const std::string& place) {
    for (const auto& [key, member] : object.items()) WEFT_TRY_VOID(check(member, shape, place + "/" + key));
    return {};
  }

  Result<void> checkArray(Json& value, const Json& shape, const std::string& place) {
    if (!value.is_array()) return otherType(value, place, "an array");
    for (std::size_t i = 0; i < value.size(); ++i)
      WEFT_TRY_VOID(check(value[i], shape, place + "/" + std::to_string(i)));
    return {};
  }

  Result<void> checkWhole(Json& value, std::int64_t largest, const std::string& place) {
    const std::optional<std::int64_t> whole = wholeNumber(value, largest);
    if (!whole) return otherType(value, place, "a whole number from 0 to " + std::to_string(largest));
    value = static_cast<std::uint64_t>(*whole);
    return {};
  }

  Result<void> otherType(const Json& value, const std::string& place, const std::string& expected) const {
    return fail(place + " is " + quoted(value) + ", not " + expected, path_.string());
  }

  Json shapes_;
  const std::filesystem::path& path_;
  std::vector<std::string>& warnings_;
  std::string firstNull_;
  std::size_t nulls_ = 0;
};

}  // namespace

Result<void> checkShape(Json& file, const std::filesystem::path& path, std::vector<std::string>& warnings) {
  return ShapeCheck(path, warnings).check(file);
}

}  // namespace weft
