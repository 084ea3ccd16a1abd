#include "GltfData.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "GltfDraco.h"
#include "GltfMeshopt.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

constexpr auto kKnownExtensions = std::to_array<std::string_view>({
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "WEFT_materials_btf",
});

std::string textOf(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A member, shortened, that is a text or number; else empty.
std::string textMember(const Json& object, const char* key) {
  constexpr std::size_t kLongest = 20;
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  if (found == object.end() || (!found->is_string() && !found->is_number())) return {};
  return (found->is_string() ? found->get<std::string>() : found->dump()).substr(0, kLongest);
}

/// A JSON pointer's token: "~" and "/" would end it.
std::string escaped(const std::string& key) {
  std::string token;
  for (const char c : key) token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return token;
}

/// Descends by recursion: readGltfFile() has seen to it that the text is not nested deeply.
void collect(const Json& value, const std::string& place, std::vector<GltfData>& data) {
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], place + "/" + std::to_string(i), data);
  if (!value.is_object()) return;
  for (const auto& [key, member] : value.items()) {
    if (key == "extras") {
      data.push_back({place, key, textOf(member)});
    } else if (key == "extensions" && member.is_object()) {
      for (const auto& [name, extension] : member.items())
        if (isKnownExtension(name))
          collect(extension, place + "/extensions/" + escaped(name), data);
        else
          data.push_back({place, name, textOf(extension)});
    } else {
      collect(member, place + "/" + escaped(key), data);
    }
  }
}

}  // namespace

bool isKnownExtension(std::string_view name) {
  if (name == kDracoExtension) return kUnpacksDraco;
  if (name == kMeshoptExtension) return kUnpacksMeshopt;
  return std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) != kKnownExtensions.end();
}

GltfContents contentsOf(const Json& root) {
  GltfContents contents;
  if (!root.is_object()) return contents;
  collect(root, "", contents.data);
  if (const auto materials = root.find("materials"); materials != root.end() && materials->is_array())
    for (const Json& material : *materials) contents.materials.push_back(textOf(material));
  if (const auto required = root.find("extensionsRequired"); required != root.end() && required->is_array())
    for (const Json& name : *required)
      if (name.is_string()) contents.required.push_back(name.get<std::string>());
  if (const auto asset = root.find("asset"); asset != root.end()) {
    contents.version = textMember(*asset, "version");
    contents.minVersion = textMember(*asset, "minVersion");
  }
  return contents;
}

}  // namespace weft
