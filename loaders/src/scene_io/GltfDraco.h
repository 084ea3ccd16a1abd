#pragma once

#include "GltfFile.h"

namespace weft {

constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

/// Fails on a mesh that is there in Draco alone. Weft does not unpack it: Debian's library of Draco
/// holds another version of tinygltf, whose functions would take the place of the one that reads
/// our files.
Result<void> refuseDraco(const GltfFile& file);

}  // namespace weft
