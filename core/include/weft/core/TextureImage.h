#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "weft/core/FloatImage.h"

namespace weft {

/// What the texels of a texture are made of.
enum class TexelType {
  Half,
  Float,
  SignedByte,      ///< -1..1 in steps of 1/127
  SharedExponent,  ///< three numbers from 0 in 32 bits, GL's RGB9_E5
  WholeByte,       ///< 0, 1, ... 255, which shaders read as whole numbers, too
  WholeWord,       ///< 0, 1, ... 65535, likewise
};
constexpr TexelType texelType(Precision precision) {
  return precision == Precision::Half ? TexelType::Half : TexelType::Float;
}

/// Texels as a GPU takes them, `[row][column][channel]` a layer, layers after one
/// another, and so for each level. Row 0 is at the top.
///
/// Level i has sides halved i times, rounded down, at least 1, and as many layers. Not thread safe
/// while written to, but different layers may be written at once.
class TextureImage {
 public:
  TextureImage() = default;
  /// All values 0. Sizes are positive, channels 1 to 4, of SharedExponent 3.
  TextureImage(int width, int height, int layers, int channels, TexelType type, int levels = 1);

  int width(int level = 0) const { return sideOf(width_, level); }
  int height(int level = 0) const { return sideOf(height_, level); }
  int layers() const { return layers_; }
  int channels() const { return channels_; }
  int levels() const { return static_cast<int>(levels_.size()); }
  TexelType type() const { return type_; }
  bool empty() const { return levels_.empty(); }

  /// Writes values into the texels of a layer from a place on, one channel after another, across
  /// the borders of layers: where four channels are too few, the value belongs to the same place of
  /// the next layer. Of SharedExponent all three are written at once.
  void set(int x, int y, int layer, int channel, std::span<const float> values, int level = 0);
  float at(int x, int y, int layer, int channel, int level = 0) const;
  std::span<const std::byte> bytes(int level = 0) const { return levels_[static_cast<std::size_t>(level)]; }
  /// Of all levels.
  std::uint64_t byteCount() const;

 private:
  static int sideOf(int side, int level) { return side >> level > 0 ? side >> level : 1; }
  std::size_t texelBytes() const;
  std::size_t offset(int x, int y, int layer, int channel, int level) const;

  int width_ = 0;
  int height_ = 0;
  int layers_ = 0;
  int channels_ = 0;
  TexelType type_ = TexelType::Half;
  std::vector<std::vector<std::byte>> levels_;
};

}  // namespace weft
