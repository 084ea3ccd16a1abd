#pragma once

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
};

/// Of a file's JSON that is not nested deeply; what is not JSON gives nothing.
GltfContents contentsOf(std::string_view json);

}  // namespace weft
