#pragma once

#include <filesystem>
#include <memory>

#include "weft/core/Result.h"
#include "weft/materials/BTFMaterial.h"

namespace weft {

/// A `.rf.exr` as a material: readReflectanceField() with Weft's own models, then BTFMaterial::create().
Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options = {});

}  // namespace weft
