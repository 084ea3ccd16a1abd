#include "weft/chunks/TextureChunk.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "SamplingParameters.h"
#include "TextureFormat.h"
#include "weft/chunks/GLName.h"

namespace weft {

namespace {

/// Everything that an immutable texture is made with.
struct TextureLayout {
  GLenum storage = 0;
  int width = 0;
  int height = 0;
  int layers = 0;
  int levels = 0;

  bool operator==(const TextureLayout&) const = default;
};

struct TextureObjects {
  GLTexture texture;
  TextureLayout layout;
  std::uint64_t version = 0;
};

/// Texels as GL takes them.
struct Texels {
  TextureFormat format;
  int width = 0;
  int height = 0;
  int layers = 0;
  std::vector<const void*> levels;
  bool hasLevels = false;  ///< all that there are to be
  /// what `levels` points to where the image had to be converted
  std::vector<std::uint8_t> expanded;
};

GLenum target(TextureShape shape) {
  switch (shape) {
    case TextureShape::TwoDimensional:
      return GL_TEXTURE_2D;
    case TextureShape::Array:
      return GL_TEXTURE_2D_ARRAY;
    case TextureShape::Rectangle:
      return GL_TEXTURE_RECTANGLE;
    case TextureShape::ThreeDimensional:
      return GL_TEXTURE_3D;
    case TextureShape::Cube:
      return GL_TEXTURE_CUBE_MAP;
  }
  return GL_NONE;
}

bool isTwoDimensional(TextureShape shape) {
  return shape == TextureShape::TwoDimensional || shape == TextureShape::Rectangle;
}

/// Grey, or grey and alpha, as RGB, or RGBA.
std::vector<std::uint8_t> expandGrey(const Image& image) {
  std::vector<std::uint8_t> expanded;
  expanded.reserve(image.bytes.size() * 3);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.bytes.size(); i += channels) {
    expanded.insert(expanded.end(), 3, image.bytes[i]);
    if (channels == 2) expanded.push_back(image.bytes[i + 1]);
  }
  return expanded;
}

Texels texelsOf(const FloatImage& image, const TextureOptions&) {
  return {floatFormat(image.precision(), image.channelCount()),
          image.width(),
          image.height(),
          image.layers(),
          {image.values().data()},
          false,
          {}};
}

Texels texelsOf(const Image& image, const TextureOptions& options) {
  Texels texels{byteFormat(image.channels), image.width, image.height, 1, {image.bytes.data()}, false, {}};
  if (!options.srgb) return texels;
  if (image.channels <= 2) {
    texels.expanded = expandGrey(image);
    texels.levels = {texels.expanded.data()};
  }
  texels.format = srgbFormat(image.channels <= 2 ? image.channels + 2 : image.channels);
  return texels;
}

Texels texelsOf(const WideImage& image, const TextureOptions&) {
  return {wordFormat(image.channels), image.width, image.height, 1, {image.words.data()}, false, {}};
}
Texels texelsOf(const TextureImage& image, const TextureOptions&) {
  Texels texels{texelFormat(image.type(), image.channels()),
                image.width(),
                image.height(),
                image.layers(),
                {},
                true,
                {}};
  for (int level = 0; level < image.levels(); ++level) texels.levels.push_back(image.bytes(level).data());
  return texels;
}

bool isEmpty(const FloatImage& image) {
  return image.empty();
}
bool isEmpty(const Image& image) {
  return image.bytes.empty();
}
bool isEmpty(const WideImage& image) {
  return image.words.empty();
}
bool isEmpty(const TextureImage& image) {
  return image.empty();
}

/// What the shape asks of the image; a caller who breaks it could only get a wrong picture.
void expectLayersFit(const TextureOptions& options, const auto& image) {
  WEFT_EXPECT(!options.srgb, "float images are linear");
  WEFT_EXPECT(!isTwoDimensional(options.shape) || image.layers() == 1, "a 2D texture has one layer");
  WEFT_EXPECT(options.shape != TextureShape::Cube || (image.layers() == 6 && image.width() == image.height()),
              "a cube texture has six square layers");
}
void expectFits(const TextureOptions& options, const FloatImage& image) {
  WEFT_EXPECT(image.channelCount() <= 4, "a texture has 1 to 4 channels");
  expectLayersFit(options, image);
}
void expectFits(const TextureOptions& options, const TextureImage& image) {
  expectLayersFit(options, image);
}
/// An Image or WideImage of so many values.
template <class AnyWidth>
void expectFlat(const TextureOptions& options, const AnyWidth& image, std::size_t values) {
  WEFT_EXPECT(options.shape != TextureShape::Cube, "a cube texture has six square layers");
  WEFT_EXPECT(image.channels >= 1 && image.channels <= 4, "a texture has 1 to 4 channels");
  WEFT_EXPECT(values == static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                            static_cast<std::size_t>(image.channels),
              "an image has width x height x channels values");
}
void expectFits(const TextureOptions& options, const Image& image) {
  expectFlat(options, image, image.bytes.size());
}
void expectFits(const TextureOptions& options, const WideImage& image) {
  WEFT_EXPECT(!options.srgb, "GL has no sRGB of 16 bits");
  expectFlat(options, image, image.words.size());
}

int levelsOf(const TextureOptions& options, const Texels& texels) {
  if (texels.hasLevels || options.filter != TextureFilter::Mipmapped)
    return static_cast<int>(texels.levels.size());
  int size = std::max(texels.width, texels.height);
  if (options.shape == TextureShape::ThreeDimensional) size = std::max(size, texels.layers);
  return static_cast<int>(std::bit_width(static_cast<unsigned>(size)));
}

/// Reports what the GL cannot hold.
bool fits(GLContext& context, TextureShape shape, const Texels& texels) {
  const GLLimits& limits = context.limits();
  int size = limits.textureSize;
  int layers = 1;
  if (shape == TextureShape::Array) layers = limits.textureLayers;
  if (shape == TextureShape::Rectangle) size = limits.rectangleSize;
  if (shape == TextureShape::ThreeDimensional) size = layers = limits.volumeSize;
  if (shape == TextureShape::Cube) size = limits.cubeSize, layers = 6;
  if (texels.width <= size && texels.height <= size && texels.layers <= layers) return true;
  context.report(
      {fmt::format("a texture of {} x {} x {} is larger than the {} x {} x {} that this OpenGL allows",
                   texels.width, texels.height, texels.layers, size, size, layers),
       {},
       {}});
  return false;
}

GLTexture makeTexture(const TextureLayout& layout, const TextureOptions& options) {
  GLuint name = 0;
  glCreateTextures(target(options.shape), 1, &name);
  // A cube's six layers are not said: it always has them.
  if (isTwoDimensional(options.shape) || options.shape == TextureShape::Cube)
    glTextureStorage2D(name, layout.levels, layout.storage, layout.width, layout.height);
  else
    glTextureStorage3D(name, layout.levels, layout.storage, layout.width, layout.height, layout.layers);
  setSampling({options.filter, options.wrap, options.wrapV, options.magnification}, name,
              glTextureParameteri);
  return GLTexture(name);
}

void upload(GLuint texture, const TextureOptions& options, const Texels& texels, int level) {
  const int width = std::max(texels.width >> level, 1), height = std::max(texels.height >> level, 1);
  const auto [storage, channels, type] = texels.format;
  const void* values = texels.levels[static_cast<std::size_t>(level)];
  if (isTwoDimensional(options.shape))
    glTextureSubImage2D(texture, level, 0, 0, width, height, channels, type, values);
  else
    glTextureSubImage3D(texture, level, 0, 0, 0, width, height, texels.layers, channels, type, values);
}

void upload(GLuint texture, const TextureOptions& options, const Texels& texels) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int level = 0; level < static_cast<int>(texels.levels.size()); ++level)
    upload(texture, options, texels, level);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);  // GL's default
  if (!texels.hasLevels && options.filter == TextureFilter::Mipmapped) glGenerateTextureMipmap(texture);
}

/// Brings the GL texture up to date, or reports why that cannot be.
bool update(GLContext& context, TextureObjects& objects, const TextureOptions& options,
            const Texels& texels) {
  if (!fits(context, options.shape, texels)) return false;
  const TextureLayout layout{texels.format.storage, texels.width, texels.height, texels.layers,
                             levelsOf(options, texels)};
  if (layout != objects.layout) {
    objects.texture = makeTexture(layout, options);
    objects.layout = layout;
  }
  upload(objects.texture, options, texels);
  return true;
}

}  // namespace

TextureChunk::TextureChunk(std::shared_ptr<const FloatImage> image, TextureOptions options)
    : options_(options) {
  replaceImage(std::move(image));
}

TextureChunk::TextureChunk(std::shared_ptr<const Image> image, TextureOptions options) : options_(options) {
  replaceImage(std::move(image));
}

TextureChunk::TextureChunk(std::shared_ptr<const WideImage> image, TextureOptions options)
    : options_(options) {
  replaceImage(std::move(image));
}

TextureChunk::TextureChunk(std::shared_ptr<const TextureImage> image, TextureOptions options)
    : options_(options) {
  replaceImage(std::move(image));
}

TextureChunk::TextureChunk(std::shared_ptr<const TextureSource> source, TextureOptions options)
    : options_(options) {
  replaceImage(std::shared_ptr<const TextureImage>());
  source_ = std::move(source);
}

void TextureChunk::setImage(std::shared_ptr<const FloatImage> image) {
  replaceImage(std::move(image));
}

void TextureChunk::setImage(std::shared_ptr<const Image> image) {
  replaceImage(std::move(image));
}

void TextureChunk::replaceImage(AnyImage image) {
  WEFT_EXPECT(
      options_.shape != TextureShape::Rectangle || (options_.wrap == TextureWrap::Clamp && !options_.wrapV &&
                                                    options_.filter != TextureFilter::Mipmapped),
      "a rectangle texture has no repeat and no mipmaps");
  std::visit(
      [this](const auto& held) {
        if (held && !isEmpty(*held)) expectFits(options_, *held);
      },
      image);
  image_ = std::move(image);
  source_ = nullptr;
  ++version_;
}

unsigned TextureChunk::texture(GLContext& context) const {
  const bool hasImage = std::visit([](const auto& held) { return held && !isEmpty(*held); }, image_);
  if (!hasImage && !source_) return 0;
  auto& objects = context.objectsOf<TextureObjects>(owner_);
  if (objects.version == version_) return objects.texture;
  bool made = false;
  if (source_) {
    const Result<std::shared_ptr<const TextureImage>> image = (*source_)();
    if (image) expectFits(options_, **image);
    if (!image) context.report(image.error());
    made = image && update(context, objects, options_, texelsOf(**image, options_));
  } else {
    made = std::visit(
        [&](const auto& held) { return update(context, objects, options_, texelsOf(*held, options_)); },
        image_);
  }
  if (!made) return 0;
  objects.version = version_;
  return objects.texture;
}

void TextureChunk::activate(GLContext& context, unsigned slot) const {
  glBindTextureUnit(slot - TextureSlot, texture(context));
}

void TextureChunk::changeFrom(GLContext& context, const Chunk& old, unsigned slot) const {
  // Every target of a unit has a binding of its own: another target's would stay beside ours.
  if (static_cast<const TextureChunk&>(old).options_.shape != options_.shape) old.deactivate(context, slot);
  activate(context, slot);
}

void TextureChunk::deactivate(GLContext&, unsigned slot) const {
  glBindTextureUnit(slot - TextureSlot, 0);
}

bool TextureChunk::isEqual(const Chunk& other) const {
  const auto& texture = static_cast<const TextureChunk&>(other);
  return image_ == texture.image_ && source_ == texture.source_ && options_ == texture.options_;
}

}  // namespace weft
