#pragma once

#include "weft/core/Result.h"
#include "weft/core/TextureImage.h"
#include "weft/reflectance/CoordinateMap.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// The surface that a map makes of a field whose parameters are filtered (filtersParameters()), so
/// coarse that it has as many texels as the sample, and levels of the same sizes.
///
/// There a texel covers many places at which the map jumps, so that no texel of the sample has what
/// it shows. Each is the average of the light of those that it covers: of numbers, and of base
/// colours weighted by how bright they are.
std::vector<FieldLevel> mappedLevels(const ReflectanceField& field, const CoordinateMap& map);

/// Columns and rows of the sample as a texture, whole numbers: two bytes a texel for samples of up
/// to 256 x 256 texels, otherwise four.
TextureImage packCoordinates(const CoordinateMap& map);

/// Fails where the map's sample has another size than a field of so many columns and rows.
Result<void> checkMapFits(const CoordinateMap& map, glm::ivec2 fieldSize);

}  // namespace weft
