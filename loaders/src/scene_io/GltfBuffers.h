#pragma once

#include <nlohmann/json_fwd.hpp>

#include "GltfFile.h"

namespace weft {

/// Reads the buffers that the JSON lists: embedded ones, those of files, and `binary`, which stands
/// beside the JSON in a .glb. A file may be longer than its buffer.
Result<void> readBuffers(const nlohmann::ordered_json& root, const GltfBuffer& binary, GltfFile& file);

}  // namespace weft
