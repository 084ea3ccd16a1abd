#include "weft/core/ToneMapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "weft/core/Contract.h"

namespace weft {

glm::vec3 toneMapped(glm::vec3 radiance, ToneCurve curve) {
  if (curve == ToneCurve::None) return radiance;
  constexpr float kLinear = 0.8f, kRest = 1.0f - kLinear, kFading = 0.15f;
  for (int c = 0; c < 3; ++c) radiance[c] = radiance[c] > 0.0f ? std::min(radiance[c], 1e30f) : 0.0f;
  const float peak = std::max({radiance.x, radiance.y, radiance.z});
  if (peak <= kLinear) return radiance;
  const float shown = 1.0f - kRest * kRest / (peak - kLinear + kRest);
  const float white = 1.0f - 1.0f / (1.0f + kFading * (peak - shown));
  return glm::mix(radiance / peak * shown, glm::vec3(shown), white);
}

void expose(FloatImage& image, float stops, ToneCurve curve) {
  const auto r = image.channelIndex("R"), g = image.channelIndex("G"), b = image.channelIndex("B");
  WEFT_EXPECT(r && g && b, "a picture has the channels R, G, B");
  const std::array channels{*r, *g, *b};
  const float factor = std::exp2(stops);
  for (int layer = 0; layer < image.layers(); ++layer)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const auto texel = image.texel(x, y, layer);
        glm::vec3 color;
        for (std::size_t c = 0; c < 3; ++c)
          color[static_cast<int>(c)] = factor * texel[static_cast<std::size_t>(channels[c])];
        color = toneMapped(color, curve);
        for (std::size_t c = 0; c < 3; ++c)
          texel[static_cast<std::size_t>(channels[c])] = color[static_cast<int>(c)];
      }
}

}  // namespace weft
