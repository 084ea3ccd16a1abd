#include "weft/core/TextureImage.h"

#include <Imath/half.h>

#include <cstring>

#include "weft/core/Contract.h"

namespace weft {

TextureImage::TextureImage(int width, int height, int layers, int channels, Precision precision, int levels)
    : width_(width), height_(height), layers_(layers), channels_(channels), precision_(precision) {
  WEFT_EXPECT(width > 0 && height > 0 && layers > 0 && levels > 0, "a TextureImage has a positive size");
  WEFT_EXPECT(channels >= 1 && channels <= 4, "a texture has 1 to 4 channels");
  for (int level = 0; level < levels; ++level) levels_.emplace_back(offset(0, 0, layers, 0, level));
}

std::size_t TextureImage::offset(int x, int y, int layer, int channel, int level) const {
  const auto size = [](int value) { return static_cast<std::size_t>(value); };
  const std::size_t texel = (size(layer) * size(height(level)) + size(y)) * size(width(level)) + size(x);
  return (texel * size(channels_) + size(channel)) * valueBytes();
}

void TextureImage::set(int x, int y, int layer, int channel, std::span<const float> values, int level) {
  std::vector<std::byte>& bytes = levels_[static_cast<std::size_t>(level)];
  for (const float value : values) {
    std::byte* to = bytes.data() + offset(x, y, layer + channel / channels_, channel % channels_, level);
    if (precision_ == Precision::Float) {
      std::memcpy(to, &value, sizeof(value));
    } else {
      const half rounded(value);
      std::memcpy(to, &rounded, sizeof(rounded));
    }
    ++channel;
  }
}

float TextureImage::at(int x, int y, int layer, int channel, int level) const {
  const std::byte* from =
      levels_[static_cast<std::size_t>(level)].data() + offset(x, y, layer, channel, level);
  if (precision_ == Precision::Half) {
    half value;
    std::memcpy(static_cast<void*>(&value), from, sizeof(value));
    return value;
  }
  float value = 0.0f;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

std::uint64_t TextureImage::byteCount() const {
  std::uint64_t count = 0;
  for (const auto& level : levels_) count += level.size();
  return count;
}

}  // namespace weft
