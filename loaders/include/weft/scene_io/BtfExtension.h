#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterialOptions.h"

namespace weft {

/// What docs/gltf-extension.md says of a material with WEFT_materials_btf.
struct BtfExtension {
  std::filesystem::path field;     ///< the .rf.exr; written relative to the glTF file
  glm::vec2 scale{1.0f};           ///< repetitions per unit of texture coordinates, positive
  int texCoord = 0;                ///< the set of texture coordinates
  std::filesystem::path map{};     ///< a .coords.exr, likewise; empty: none
  Tiling tiling = Tiling::Repeat;  ///< without a map
};

/// Copies a glTF file, .gltf or .glb, and gives materials, by name, a reflectance field. Everything
/// else stays: the fallback of other viewers, extensions that Weft does not know, extras, the
/// binary chunk.
///
/// `target` may be `source`; in another folder only where the file refers to no others. The
/// reflectance fields need not exist yet. Fails, with file and reason, on what is not glTF, and on
/// a name that no material has.
Result<void> writeBtfExtension(const std::filesystem::path& source, const std::filesystem::path& target,
                               const std::map<std::string, BtfExtension>& materials);

}  // namespace weft
