#include "weft/scene_io/BTFMaterialLoader.h"

#include "weft/io/ReflectanceFieldFile.h"

namespace weft {

Result<std::shared_ptr<BTFMaterial>> loadBTFMaterial(const std::filesystem::path& path,
                                                     const BTFMaterialOptions& options,
                                                     const ModelRegistry& models) {
  WEFT_TRY(ReflectanceField field, readReflectanceField(path, models));
  return BTFMaterial::create(std::make_shared<const ReflectanceField>(std::move(field)), options);
}

}  // namespace weft
