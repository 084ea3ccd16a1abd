#pragma once

#include "weft/chunks/TextureChunk.h"

namespace weft {

/// A cube map from six square layers in GL's order: +X, -X, +Y, -Y, +Z, -Z. Lookup tables take
/// TextureFilter::Nearest, and Precision::Float holds integers up to 2^24 exactly.
class CubeTextureChunk : public TextureChunk {
 public:
  explicit CubeTextureChunk(std::shared_ptr<const FloatImage> image,
                            TextureFilter filter = TextureFilter::Nearest)
      : TextureChunk(std::move(image), {.shape = TextureShape::Cube, .filter = filter}) {}
};

}  // namespace weft
