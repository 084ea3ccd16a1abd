#include "weft/materials/BTFMap.h"

#include "weft/chunks/TextureChunk.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/reflectance/MapTextures.h"
#include "weft/shaders/Bindings.h"

namespace weft {

Result<std::shared_ptr<const BTFMap>> BTFMap::create(const CoordinateMap& map, const BTFTextures& textures,
                                                     const BTFTextures::FieldSource& field) {
  WEFT_TRY_VOID(checkMapFits(map, textures.size()));
  std::shared_ptr<BTFMap> made(new BTFMap);
  made->size_ = {map.width(), map.height()};
  made->sampleSize_ = textures.size();
  made->hasLevels_ = textures.filtersParameters();
  const auto add = [&](int unit, TextureImage image, const TextureOptions& options) {
    made->chunks_.emplace_back(
        textureSlot(static_cast<unsigned>(unit)),
        std::make_shared<TextureChunk>(std::make_shared<const TextureImage>(std::move(image)), options));
  };
  add(bindings::coordinatesUnit, packCoordinates(map), {});
  if (!made->hasLevels_) return made;
  WEFT_TRY(const ReflectanceField source, field());
  WEFT_TRY_VOID(checkMapFits(map, {source.width(), source.height()}));
  const std::vector<FieldLevel> levels = mappedLevels(source, map);
  const TextureOptions filtered{
      .shape = TextureShape::Array, .filter = TextureFilter::Mipmapped, .wrap = TextureWrap::Repeat};
  add(bindings::sharedParametersUnit, packFilteredNumbers({source.levels(), levels}), filtered);
  add(bindings::baseColorsUnit, packBaseColors({source.levels(), levels}), filtered);
  return made;
}

}  // namespace weft
