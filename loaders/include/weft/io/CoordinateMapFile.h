#pragma once

#include <filesystem>

#include "weft/core/Result.h"
#include "weft/reflectance/CoordinateMap.h"

namespace weft {

/// Writes a `.coords.exr` (docs/coordinate-maps.md): channels X and Y, whole numbers, and the
/// sample's size and name in the header. Written beside its place and renamed.
Result<void> writeCoordinateMap(const std::filesystem::path& path, const CoordinateMap& map);

/// Reads it back. Fails, with file and reason, on anything that is not such a file; sizes are
/// checked before memory is taken.
Result<CoordinateMap> readCoordinateMap(const std::filesystem::path& path);

/// Whether a file is an OpenEXR file that says of itself that it holds a coordinate map.
bool isCoordinateMap(const std::filesystem::path& path);

}  // namespace weft
