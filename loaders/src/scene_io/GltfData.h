#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "weft/scene_io/GltfLoader.h"

namespace weft {

/// Whether Weft itself reads an extension.
bool isKnownExtension(std::string_view name);

/// What a file's JSON has beyond what Weft reads, in its order.
struct GltfContents {
  std::vector<GltfData> data;          ///< unknown extensions and extras of all objects
  std::vector<std::string> materials;  ///< each one's text
  std::vector<std::string> required;   ///< extensions that the file cannot be shown without
  std::string version;                 ///< "2.0"
  std::string minVersion;              ///< of glTF, that readers must know; mostly empty
};

/// Of a file's JSON, which is not nested deeply; its types need not be right.
GltfContents contentsOf(const nlohmann::ordered_json& root);

}  // namespace weft
