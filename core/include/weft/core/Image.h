#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft {

/// An 8-bit image as decoded from JPEG or PNG: `bytes[row][column][channel]`, row 0 at the top,
/// values as stored (encoded).
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  std::vector<std::uint8_t> bytes;

  Image() = default;
  Image(int imageWidth, int imageHeight, int channelCount)
      : width(imageWidth),
        height(imageHeight),
        channels(channelCount),
        bytes(static_cast<std::size_t>(imageWidth) * static_cast<std::size_t>(imageHeight) *
              static_cast<std::size_t>(channelCount)) {}

  const std::uint8_t* pixel(int x, int y) const { return bytes.data() + offset(x, y); }
  std::uint8_t* pixel(int x, int y) { return bytes.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
};

/// The same with 16 bits a channel, 65535 for what is 255 in 8: `words[row][column][channel]`.
struct WideImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint16_t> words;
};

}  // namespace weft
