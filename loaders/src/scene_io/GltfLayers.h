#pragma once

#include "GltfFile.h"
#include "GltfTextures.h"
#include "weft/materials/PBROptions.h"

namespace weft {

/// Reads what Khronos' extensions lay on a material, or change of it: clearcoat, sheen, anisotropy,
/// iridescence, transmission. A layer whose factor is 0 is not looked at further. `of`: "of
/// material "seat"", for people.
Result<void> readLayers(const GltfFile& file, GltfTextures& textures, const tinygltf::Material& material,
                        const std::string& of, PBROptions& options);

}  // namespace weft
