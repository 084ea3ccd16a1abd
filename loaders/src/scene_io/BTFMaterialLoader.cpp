#include "weft/scene_io/BTFMaterialLoader.h"

namespace weft {

Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options, FieldCache& fields,
                                                     const std::filesystem::path& map) {
  WEFT_TRY(const auto textures, fields.load(path, options.preparedForEnvironments));
  WEFT_TRY(auto material, BTFMaterial::create(textures, options));
  if (map.empty()) return material;
  WEFT_TRY(auto loaded, fields.loadMap(map, *textures, path));
  WEFT_TRY_VOID(material->setMap(std::move(loaded)));
  return material;
}

Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options,
                                                     const ModelRegistry& models) {
  FieldCache fields(models);
  return loadBTFMaterial(path, options, fields);
}

}  // namespace weft
