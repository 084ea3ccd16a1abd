#pragma once

#include <algorithm>

#include "weft/core/FloatImage.h"

namespace weft::test {

/// A picture of stored values, 40 x 32 pixels, whose bytes are `value(x, y, channel)`.
template <class Value>
FloatImage pictureOfBytes(const Value& value) {
  FloatImage image(40, 32, {"R", "G", "B"});
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(value(x, y, c)) / 255.0f;
  return image;
}

/// A wild pattern; as numpy: (x*(7+2*c) + y*(11-3*c) + x*y//(5+c) + shift*((x+2*y+c)%5)) % 256.
inline FloatImage wildPicture(int shift) {
  return pictureOfBytes([&](int x, int y, int c) {
    return (x * (7 + 2 * c) + y * (11 - 3 * c) + x * y / (5 + c) + shift * ((x + 2 * y + c) % 5)) % 256;
  });
}

/// A ramp of colours with squares on it, numpy.clip(x*(5+c) + y*(3-c) + 40 + squares *
/// ((x//6 + y//6) % 2) * (20-8*c), 0, 255).
inline FloatImage smoothPicture(int squares) {
  return pictureOfBytes([&](int x, int y, int c) {
    const int square = squares * ((x / 6 + y / 6) % 2) * (20 - 8 * c);
    return std::clamp(x * (5 + c) + y * (3 - c) + 40 + square, 0, 255);
  });
}

}  // namespace weft::test
