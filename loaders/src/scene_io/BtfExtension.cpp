#include "weft/scene_io/BtfExtension.h"

#include <cctype>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "GltfContainer.h"
#include "GltfReference.h"
#include "weft/core/AtomicFile.h"
#include "weft/core/Contract.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kName = "WEFT_materials_btf";

/// A path as a relative reference: what URIs reserve is written as %20.
std::string uriFrom(const std::filesystem::path& path) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string uri;
  for (const char c : path.generic_string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || std::strchr("-._~/", c))
      uri += c;
    else
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return uri;
}

/// Whether buffers or images are files of their own.
bool refersToFiles(const Json& root) {
  for (const char* list : {"buffers", "images"}) {
    const auto found = root.find(list);
    if (found == root.end() || !found->is_array()) continue;
    for (const Json& object : *found)
      if (object.is_object() && object.contains("uri") && object["uri"].is_string() &&
          !isDataUri(object["uri"].get_ref<const std::string&>()))
        return true;
  }
  return false;
}

Json& memberObject(Json& object, const char* key) {
  Json& member = object[key];
  if (!member.is_object()) member = Json::object();
  return member;
}

/// Gives it to every material of the name; false where there is none.
bool extendMaterials(Json& root, const std::string& name, const Json& values) {
  bool found = false;
  if (!root.contains("materials") || !root["materials"].is_array()) return false;
  for (Json& material : root["materials"]) {
    if (!material.is_object() || !material.contains("name") || material["name"] != name) continue;
    Json& extension = memberObject(memberObject(material, "extensions"), kName);
    for (const char* earlier : {"map", "tiling"}) extension.erase(earlier);
    extension.update(values);
    found = true;
  }
  return found;
}

void nameAsUsed(Json& root) {
  Json& used = root["extensionsUsed"];
  if (!used.is_array()) used = Json::array();
  for (const Json& name : used)
    if (name == kName) return;
  used.push_back(kName);
}

void appendWord(std::string& bytes, std::size_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 255);
}

/// The file with another JSON; what follows the JSON of a .glb stays byte for byte.
std::string withJson(const std::vector<std::uint8_t>& file, std::string_view oldJson, std::string json) {
  const auto* end = reinterpret_cast<const char*>(file.data()) + file.size();
  const char* rest = oldJson.data() + oldJson.size();
  if (oldJson.size() == file.size()) return json;  // a .gltf
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  appendWord(bytes, 2);
  appendWord(bytes, 20 + json.size() + static_cast<std::size_t>(end - rest));
  appendWord(bytes, json.size());
  return bytes + "JSON" + json + std::string(rest, end);
}

/// The extension in a file in this folder.
Json valuesOf(const BtfExtension& extension, const std::filesystem::path& folder) {
  const auto uriOf = [&](const std::filesystem::path& path) {
    std::error_code ignored;
    return uriFrom(std::filesystem::absolute(path, ignored).lexically_relative(folder));
  };
  Json values{{"uri", uriOf(extension.field)},
              {"scale", {extension.scale.x, extension.scale.y}},
              {"texCoord", extension.texCoord}};
  if (!extension.map.empty()) values["map"] = uriOf(extension.map);
  if (extension.tiling == Tiling::Stochastic) values["tiling"] = "stochastic";
  return values;
}

}  // namespace

Result<void> writeBtfExtension(const std::filesystem::path& source, const std::filesystem::path& target,
                               const std::map<std::string, BtfExtension>& materials) {
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readGltfBytes(source));
  WEFT_TRY(const GltfContainer container, containerOf(bytes, source));
  WEFT_TRY(Json root, parseJson(container, source));
  const std::string_view text = container.json;
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::absolute(target, ignored).parent_path();
  if (std::filesystem::absolute(source, ignored).parent_path() != folder && refersToFiles(root))
    return fail("the file names others beside it, which a copy elsewhere would not find", source.string(),
                "write the copy beside it");
  for (const auto& [name, extension] : materials) {
    WEFT_EXPECT(extension.scale.x > 0.0f && extension.scale.y > 0.0f && extension.texCoord >= 0,
                "a reflectance field has a positive scale and a set of texture coordinates");
    if (!extendMaterials(root, name, valuesOf(extension, folder)))
      return fail("there is no material \"" + name + "\"", source.string());
  }
  nameAsUsed(root);
  const bool spaced = text.find('\n') != std::string_view::npos;
  WEFT_TRY(AtomicFile file, AtomicFile::create(target));
  const std::string written = withJson(bytes, text, root.dump(spaced ? 2 : -1));
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(written.data(), static_cast<std::streamsize>(written.size()));
  stream.close();
  if (!stream) return fail("the file cannot be written", target.string());
  return file.commit();
}

}  // namespace weft
