#pragma once

#include "GltfFile.h"

namespace weft {

constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
/// Whether this build has Draco.
extern const bool kUnpacksDraco;

/// Unpacks the meshes that are there in Draco alone: their accessors then are as others are. Fails
/// on one that cannot be unpacked; without Draco, on any.
Result<void> unpackDraco(GltfFile& file);

}  // namespace weft
