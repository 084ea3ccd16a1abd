#pragma once

#include <filesystem>
#include <memory>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterial.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// A `.rf.exr` as a material: readReflectanceField(), then BTFMaterial::create().
Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options = {},
                                                     const ModelRegistry& models = ModelRegistry::builtin());

}  // namespace weft
