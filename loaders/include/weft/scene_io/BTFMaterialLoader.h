#pragma once

#include <filesystem>
#include <memory>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/scene_io/FieldCache.h"

namespace weft {

/// A `.rf.exr` as a material, with the textures that others of the cache have, and a `.coords.exr`
/// through which it is shown, unless that is empty; fails as FieldCache::load(), loadMap() and
/// BTFMaterial::create() do.
Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options, FieldCache& fields,
                                                     const std::filesystem::path& map = {});

/// The same of a file that no other material shows.
Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options = {},
                                                     const ModelRegistry& models = ModelRegistry::builtin());

}  // namespace weft
