#include "weft/scene_io/BTFMaterialLoader.h"

namespace weft {

Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options, FieldCache& fields) {
  WEFT_TRY(auto textures, fields.load(path, options.preparedForEnvironments));
  return BTFMaterial::create(std::move(textures), options);
}

Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options,
                                                     const ModelRegistry& models) {
  FieldCache fields(models);
  return loadBTFMaterial(path, options, fields);
}

}  // namespace weft
