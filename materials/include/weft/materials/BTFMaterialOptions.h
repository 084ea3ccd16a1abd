#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "weft/core/Result.h"
#include "weft/materials/BTFTextures.h"

namespace weft {

/// What is between the centres of texels, and where many lie in a pixel.
enum class TexelFilter {
  /// The nearest texel of the finest level: fast, with edges where texels are larger than pixels,
  /// and noise where they are smaller.
  Nearest,
  /// The results of the four nearest texels, mixed, of the two levels between which a pixel lies:
  /// four times the work, and eight between levels. Where the hardware filters a model's parameters
  /// (BTFTextures::filtersParameters()), one texel's.
  Bilinear,
};

/// How a sample covers a surface without a coordinate map.
enum class Tiling {
  Repeat,  ///< the same over and over
  /// Pieces chosen at random, blended (stochasticPlace()): without end and without repetition, for
  /// four times the work. Structures that run across pieces, like ribs, are broken. Of models whose
  /// parameters the hardware filters.
  Stochastic,
};

struct BTFMaterialOptions {
  /// Repetitions of the material, or of the map's surface, per unit of texture coordinates;
  /// positive, because a mirrored image would need mirrored directions.
  glm::vec2 textureScale{1.0f};
  glm::vec3 tint{1.0f};   ///< linear; what is shown is multiplied by it
  float exposure = 0.0f;  ///< stops: what is shown is multiplied by 2 to their power
  int interpolatedViews =
      /// 3: [Meseth 2004] eq. 4; 1: the nearest measured view alone, faster, with seams between
      /// views
      3;
  TexelFilter filter = TexelFilter::Bilinear;
  Tiling tiling = Tiling::Repeat;
  /// BTFTextures::create()'s, where a field or a file is given; textures are prepared or not.
  bool preparedForEnvironments = false;
  /// draw back faces, too, with the relief of the front seen in the mirror
  bool doubleSided = false;
};

/// Fails on numbers that cannot be shown, and on what these textures cannot do.
Result<void> checkOptions(const BTFMaterialOptions& options, const BTFTextures& textures);

}  // namespace weft
