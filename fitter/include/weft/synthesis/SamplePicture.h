#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/CoordinateMap.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// From where a picture of a sample is taken, unit vectors of the tangent frame.
struct PictureDirections {
  glm::vec3 view;
  glm::vec3 light;
};

/// What each texel of a sample shows, linear R, G, B. Texels of a registered field stay where they
/// are in the surface: a view from infinity moves them all alike.
FloatImage samplePicture(const ReflectanceField& field, const PictureDirections& directions);

/// The same of the nearest measured pairs, read in as many rows as fit into `memory` bytes.
Result<std::vector<FloatImage>> samplePictures(const BtfSource& source,
                                               std::span<const PictureDirections> directions,
                                               std::size_t memory);

/// A picture of the surface that a map makes of a sample: of its first `mostASide` rows and
/// columns.
FloatImage mappedPicture(const FloatImage& sample, const CoordinateMap& map,
                         int mostASide = CoordinateMap::kLargestSide);

}  // namespace weft
