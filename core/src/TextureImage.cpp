#include "weft/core/TextureImage.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "weft/core/Contract.h"

namespace weft {
namespace {

template <class T>
void copyTo(std::byte* to, T value) {
  std::memcpy(to, &value, sizeof(value));
}

template <class T>
T copyOf(const std::byte* from) {
  T value{};
  std::memcpy(static_cast<void*>(&value), from, sizeof(value));
  return value;
}

template <class T>
T wholeNumber(float value) {
  return static_cast<T>(std::lround(std::clamp(value, 0.0f, float{std::numeric_limits<T>::max()})));
}

// A number of a type whose channels stand for themselves.
void write(std::byte* to, TexelType type, float value) {
  switch (type) {
    case TexelType::Half:
      return copyTo(to, half(value));
    case TexelType::Float:
      return copyTo(to, value);
    case TexelType::SignedByte:
      return copyTo(to, static_cast<std::int8_t>(std::lround(127.0f * std::clamp(value, -1.0f, 1.0f))));
    case TexelType::WholeByte:
      return copyTo(to, wholeNumber<std::uint8_t>(value));
    case TexelType::WholeWord:
      return copyTo(to, wholeNumber<std::uint16_t>(value));
    case TexelType::SharedExponent:
      return;
  }
}

float read(const std::byte* from, TexelType type) {
  switch (type) {
    case TexelType::Half:
      return copyOf<half>(from);
    case TexelType::Float:
      return copyOf<float>(from);
    case TexelType::SignedByte:
      return std::max(copyOf<std::int8_t>(from) / 127.0f, -1.0f);
    case TexelType::WholeByte:
      return copyOf<std::uint8_t>(from);
    case TexelType::WholeWord:
      return copyOf<std::uint16_t>(from);
    case TexelType::SharedExponent:
      break;
  }
  return 0.0f;
}

}  // namespace

TextureImage::TextureImage(int width, int height, int layers, int channels, TexelType type, int levels)
    : width_(width), height_(height), layers_(layers), channels_(channels), type_(type) {
  WEFT_EXPECT(width > 0 && height > 0 && layers > 0 && levels > 0, "a TextureImage has a positive size");
  WEFT_EXPECT(channels >= 1 && channels <= 4, "a texture has 1 to 4 channels");
  WEFT_EXPECT(type != TexelType::SharedExponent || channels == 3, "an exponent is shared by three");
  for (int level = 0; level < levels; ++level) levels_.emplace_back(offset(0, 0, layers, 0, level));
}

std::size_t TextureImage::texelBytes() const {
  const auto channels = static_cast<std::size_t>(channels_);
  switch (type_) {
    case TexelType::Half:
    case TexelType::WholeWord:
      return 2 * channels;
    case TexelType::Float:
      return 4 * channels;
    case TexelType::SignedByte:
    case TexelType::WholeByte:
      return channels;
    case TexelType::SharedExponent:
      return 4;
  }
  return 0;
}

std::size_t TextureImage::offset(int x, int y, int layer, int channel, int level) const {
  const auto size = [](int value) { return static_cast<std::size_t>(value); };
  const std::size_t texel = (size(layer) * size(height(level)) + size(y)) * size(width(level)) + size(x);
  return texel * texelBytes() + size(channel) * (texelBytes() / size(channels_));
}

void TextureImage::set(int x, int y, int layer, int channel, std::span<const float> values, int level) {
  std::vector<std::byte>& bytes = levels_[static_cast<std::size_t>(level)];
  if (type_ == TexelType::SharedExponent) {
    WEFT_EXPECT(channel == 0 && values.size() == 3, "all three that share an exponent");
    const std::uint32_t packed = glm::packF3x9_E1x5(glm::vec3(values[0], values[1], values[2]));
    std::memcpy(bytes.data() + offset(x, y, layer, 0, level), &packed, sizeof packed);
    return;
  }
  for (const float value : values) {
    write(bytes.data() + offset(x, y, layer + channel / channels_, channel % channels_, level), type_, value);
    ++channel;
  }
}

float TextureImage::at(int x, int y, int layer, int channel, int level) const {
  const std::byte* texel = levels_[static_cast<std::size_t>(level)].data() + offset(x, y, layer, 0, level);
  if (type_ == TexelType::SharedExponent) {
    std::uint32_t packed = 0;
    std::memcpy(&packed, texel, sizeof(packed));
    return glm::unpackF3x9_E1x5(packed)[channel];
  }
  const std::byte* from =
      levels_[static_cast<std::size_t>(level)].data() + offset(x, y, layer, channel, level);
  return read(from, type_);
}

std::uint64_t TextureImage::byteCount() const {
  std::uint64_t count = 0;
  for (const auto& level : levels_) count += level.size();
  return count;
}

}  // namespace weft
