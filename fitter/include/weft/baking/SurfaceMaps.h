#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/baking/HeightField.h"
#include "weft/core/Result.h"

namespace weft {

/// Pictures of one size that describe a small surface, as sets of textures for renderers hold them.
struct SurfaceMaps {
  std::filesystem::path height;     ///< white is high
  float depth = 0.1f;               ///< of black below white, in widths of the picture
  std::filesystem::path albedo;     ///< of the diffuse reflection; empty: 0.5
  std::filesystem::path roughness;  ///< glTF's, of a dielectric; empty: nothing is mirrored
};

/// A surface with a period of 1 in x and mean height 0, a sample a pixel. Values are those that the
/// pictures store, but for the albedo, which is made linear.
///
/// Borders that do not continue each other, and what a map cannot mean, are warned about. Fails as
/// readPicture() does, and on pictures of different sizes.
Result<HeightField> readSurfaceMaps(const SurfaceMaps& maps, std::vector<std::string>& warnings);

}  // namespace weft
