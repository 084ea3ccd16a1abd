#include "TextureFormat.h"

#include "weft/core/Contract.h"

namespace weft {

namespace {

struct FormatRow {
  GLenum channels;
  GLenum byte;
  GLenum srgb;  ///< 0: GL has none
  GLenum word;
  GLenum half;
  GLenum single;
  GLenum signedByte;
  GLenum wholeChannels;  ///< of whole numbers, likewise
  GLenum wholeByte;
  GLenum wholeWord;
};

constexpr FormatRow kFormats[] = {
    {GL_RED, GL_R8, 0, GL_R16, GL_R16F, GL_R32F, GL_R8_SNORM, GL_RED_INTEGER, GL_R8UI, GL_R16UI},
    {GL_RG, GL_RG8, 0, GL_RG16, GL_RG16F, GL_RG32F, GL_RG8_SNORM, GL_RG_INTEGER, GL_RG8UI, GL_RG16UI},
    {GL_RGB, GL_RGB8, GL_SRGB8, GL_RGB16, GL_RGB16F, GL_RGB32F, GL_RGB8_SNORM, GL_RGB_INTEGER, GL_RGB8UI,
     GL_RGB16UI},
    {GL_RGBA, GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGBA16, GL_RGBA16F, GL_RGBA32F, GL_RGBA8_SNORM, GL_RGBA_INTEGER,
     GL_RGBA8UI, GL_RGBA16UI},
};

const FormatRow& row(int channels) {
  WEFT_EXPECT(channels >= 1 && channels <= 4, "a texture has 1 to 4 channels");
  return kFormats[channels - 1];
}

}  // namespace

TextureFormat floatFormat(Precision precision, int channels) {
  const FormatRow& format = row(channels);
  return {precision == Precision::Half ? format.half : format.single, format.channels, GL_FLOAT};
}

TextureFormat byteFormat(int channels) {
  return {row(channels).byte, row(channels).channels, GL_UNSIGNED_BYTE};
}

TextureFormat texelFormat(TexelType type, int channels) {
  const FormatRow& format = row(channels);
  switch (type) {
    case TexelType::Half:
      return {format.half, format.channels, GL_HALF_FLOAT};
    case TexelType::Float:
      return {format.single, format.channels, GL_FLOAT};
    case TexelType::SignedByte:
      return {format.signedByte, format.channels, GL_BYTE};
    case TexelType::SharedExponent:
      return {GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV};
    case TexelType::WholeByte:
      return {format.wholeByte, format.wholeChannels, GL_UNSIGNED_BYTE};
    case TexelType::WholeWord:
      return {format.wholeWord, format.wholeChannels, GL_UNSIGNED_SHORT};
  }
  return {};
}

TextureFormat wordFormat(int channels) {
  return {row(channels).word, row(channels).channels, GL_UNSIGNED_SHORT};
}

TextureFormat srgbFormat(int channels) {
  WEFT_EXPECT(row(channels).srgb != 0, "GL has no sRGB format of 1 or 2 channels");
  return {row(channels).srgb, row(channels).channels, GL_UNSIGNED_BYTE};
}

}  // namespace weft
