#pragma once

#include <epoxy/gl.h>

#include "weft/core/FloatImage.h"
#include "weft/core/TextureImage.h"

namespace weft {

/// How the texels of an image are stored and handed over.
struct TextureFormat {
  GLenum storage = 0;  ///< sized internal format
  GLenum channels = 0;
  GLenum type = 0;
};

/// `channels` is 1..4.
TextureFormat floatFormat(Precision precision, int channels);
TextureFormat byteFormat(int channels);
/// Of a TextureImage, as its bytes lie.
TextureFormat texelFormat(TexelType type, int channels);
TextureFormat wordFormat(int channels);
/// `channels` is 3 or 4.
TextureFormat srgbFormat(int channels);

}  // namespace weft
