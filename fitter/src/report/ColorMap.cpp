#include "weft/report/ColorMap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

namespace weft {

glm::vec3 viridis(float share) {
  // Every 32nd entry of the map's table; between them it is all but straight.
  static constexpr std::array<std::array<std::uint8_t, 3>, 9> kEntries{{{68, 1, 84},
                                                                        {71, 45, 123},
                                                                        {59, 82, 139},
                                                                        {44, 114, 142},
                                                                        {33, 145, 140},
                                                                        {40, 174, 128},
                                                                        {94, 201, 98},
                                                                        {173, 220, 48},
                                                                        {253, 231, 37}}};
  constexpr float kLast = static_cast<float>(kEntries.size() - 1);
  const float place = share > 0.0f ? std::min(share, 1.0f) * kLast : 0.0f;
  const float below = std::min(std::floor(place), kLast - 1.0f);
  const auto entry = [](float index) {
    const auto& rgb = kEntries[static_cast<std::size_t>(index)];
    return glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0f;
  };
  return glm::mix(entry(below), entry(below + 1.0f), place - below);
}

Image colorMapped(const FloatImage& values, const ColorScale& scale) {
  Image image(values.width(), values.height(), 3);
  const float range = std::max(scale.highest - scale.lowest, 1e-30f);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const glm::vec3 color = viridis((values.at(x, y, 0) - scale.lowest) / range);
      for (int channel = 0; channel < 3; ++channel)
        image.pixel(x, y)[channel] = static_cast<std::uint8_t>(std::lround(255.0f * color[channel]));
    }
  return image;
}

}  // namespace weft
