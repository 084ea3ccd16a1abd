#pragma once

#include "GltfFile.h"
#include "weft/materials/PBRMaterial.h"

namespace weft {

/// A set of texture coordinates; those of a file are numbered from 0.
Result<int> texcoordSetFrom(const GltfFile& file, double number);

/// How a texture with these extensions (KHR_texture_transform) lies, on `set` where they name no
/// other.
Result<TexturePlacement> placementFrom(const GltfFile& file, const tinygltf::ExtensionMap& extensions,
                                       int set);

/// Those of the extensions of a texture that stands in an extension itself.
tinygltf::ExtensionMap placementExtensionsOf(const tinygltf::Value& texture);

}  // namespace weft
