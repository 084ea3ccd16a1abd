#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "weft/core/Result.h"

namespace weft {

/// What a glTF scene has: materials with the range and the size of their texture coordinates,
/// cameras, lights, animations, bounds, and what Weft does not show of it. Reads no textures. Fails
/// as loadGltf() does.
Result<nlohmann::ordered_json> describeScene(const std::filesystem::path& file);

}  // namespace weft
