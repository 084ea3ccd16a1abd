#pragma once

#include "GltfFile.h"

namespace weft {

constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";
/// Whether this build has meshoptimizer.
extern const bool kUnpacksMeshopt;

/// Unpacks the buffer views that are packed, which then are as others are. Without meshoptimizer,
/// packed ones keep what the file has for programs that cannot unpack, and fail where that is
/// nothing.
Result<void> unpackMeshopt(GltfFile& file);

}  // namespace weft
