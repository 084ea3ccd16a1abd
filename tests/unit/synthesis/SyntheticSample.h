#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>

#include "weft/synthesis/AppearanceVectors.h"

namespace weft::test {

/// Smooth noise in -1..1 that does not repeat.
inline float noiseAt(int x, int y, int which) {
  const auto corner = [which](int i, int j) {
    auto h = static_cast<std::uint32_t>(i * 7919 + j * 104729 + which * 15485863 + 1);
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return static_cast<float>((h ^ (h >> 16)) >> 8) * 0x1p-23f - 1.0f;
  };
  const int i = x / 3, j = y / 3;
  const float u = static_cast<float>(x % 3) / 3.0f, v = static_cast<float>(y % 3) / 3.0f;
  return (1 - v) * ((1 - u) * corner(i, j) + u * corner(i + 1, j)) +
         v * ((1 - u) * corner(i, j + 1) + u * corner(i + 1, j + 1));
}

/// A sample whose vectors a function defines.
inline AppearanceSample sampleOf(int width, int height, int dimensions,
                                 const std::function<float(int x, int y, int dimension)>& value) {
  AppearanceSample sample;
  sample.vectors = {width, height, dimensions, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int d = 0; d < dimensions; ++d) sample.vectors.values.push_back(value(x, y, d));
  sample.name = "sample";
  return sample;
}

}  // namespace weft::test
