#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "weft/chunks/Chunk.h"
#include "weft/chunks/Sampling.h"
#include "weft/core/FloatImage.h"
#include "weft/core/Image.h"
#include "weft/core/Result.h"
#include "weft/core/TextureImage.h"

namespace weft {

enum class TextureShape {
  TwoDimensional,    ///< sampler2D
  Array,             ///< sampler2DArray: one slice a layer
  Rectangle,         ///< sampler2DRect: addressed in texels; GL gives it no repeat and no mipmaps
  ThreeDimensional,  ///< sampler3D: one slice a layer
  Cube,              ///< samplerCube: six square layers, +X -X +Y -Y +Z -Z
};

struct TextureOptions {
  TextureShape shape = TextureShape::TwoDimensional;
  // As in Sampling; a SamplerChunk on the same unit overrules them.
  TextureFilter filter = TextureFilter::Nearest;
  TextureWrap wrap = TextureWrap::Clamp;
  std::optional<TextureWrap> wrapV{};
  std::optional<TextureFilter> magnification{};
  bool srgb = false;  ///< 8-bit images only: the values are sRGB, sampling gives linear ones

  bool operator==(const TextureOptions&) const = default;
};

/// Gives the texels of a texture that keeps none beside GL's: called once a context, on its thread.
using TextureSource = std::function<Result<std::shared_ptr<const TextureImage>>()>;

/// A texture on a unit, made from an image that it shares. Default: nothing bound, on any target of
/// the unit.
///
/// Row 0 of the image is v = 0, as in glTF. 1 to 4 channels become R, RG, RGB, RGBA of exactly the
/// image's precision: 16F for half, 32F for float, 8 for bytes, 16 for words; a TextureImage may be
/// 8_SNORM or RGB9_E5, too, and 8UI or 16UI with TextureFilter::Nearest. sRGB has no format of 1 or
/// 2 channels in GL, so grey becomes three equal channels. A TextureImage brings its own levels;
/// TextureFilter::Mipmapped makes those of other images. An empty image or none unbinds what was
/// there before.
class TextureChunk : public Chunk {
 public:
  /// TwoDimensional, Rectangle: an image of one layer.
  explicit TextureChunk(std::shared_ptr<const FloatImage> image, TextureOptions options = {});
  explicit TextureChunk(std::shared_ptr<const Image> image, TextureOptions options = {});
  explicit TextureChunk(std::shared_ptr<const WideImage> image, TextureOptions options = {});
  explicit TextureChunk(std::shared_ptr<const TextureImage> image, TextureOptions options = {});

  /// What the source fails with is reported to the context, and the unit left empty. Two chunks are
  /// equal where they have the same source.
  explicit TextureChunk(std::shared_ptr<const TextureSource> source, TextureOptions options = {});

  Slot kind() const override { return TextureSlot; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

  /// Replaces the image; one of the same size and format refreshes the GL texture instead of
  /// remaking it.
  void setImage(std::shared_ptr<const FloatImage> image);
  void setImage(std::shared_ptr<const Image> image);

 private:
  bool isEqual(const Chunk& other) const override;

  using AnyImage = std::variant<std::shared_ptr<const FloatImage>, std::shared_ptr<const Image>,
                                std::shared_ptr<const WideImage>, std::shared_ptr<const TextureImage>>;

  void replaceImage(AnyImage image);
  /// The texture in this context, up to date; 0 where there is none.
  unsigned texture(GLContext& context) const;

  AnyImage image_;
  std::shared_ptr<const TextureSource> source_;  ///< instead of an image
  TextureOptions options_;
  std::uint64_t version_ = 0;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

}  // namespace weft
