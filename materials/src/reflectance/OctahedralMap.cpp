#include "weft/reflectance/OctahedralMap.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {
namespace {

glm::vec2 folded(glm::vec2 p) {
  return {(1.0f - std::abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
          (1.0f - std::abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f)};
}

}  // namespace

glm::vec2 OctahedralMap::place(glm::vec3 d) {
  const glm::vec2 p = glm::vec2(d) / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  return d.z >= 0.0f ? p : folded(p);
}

glm::vec3 OctahedralMap::direction(glm::vec2 p) {
  const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
  return glm::normalize(glm::vec3(z >= 0.0f ? p : folded(p), z));
}

glm::vec3 OctahedralMap::direction(int x, int y) const {
  return direction((2.0f * glm::vec2(x, y) + 1.0f) / static_cast<float>(size) - 1.0f);
}

glm::ivec2 OctahedralMap::source(int imageX, int imageY) const {
  glm::ivec2 texel(imageX - 1, imageY - 1);
  // Beyond an edge the map goes on mirrored at the edge's middle.
  if (texel.x < 0 || texel.x >= size) texel = {texel.x < 0 ? 0 : size - 1, size - 1 - texel.y};
  if (texel.y < 0 || texel.y >= size) texel = {size - 1 - texel.x, texel.y < 0 ? 0 : size - 1};
  return texel;
}

void OctahedralMap::fillBorder(FloatImage& image) const {
  const int last = imageSize() - 1;
  const auto fill = [&](int x, int y, int layer) {
    const glm::ivec2 from = source(x, y) + 1;
    std::ranges::copy(image.texel(from.x, from.y, layer), image.texel(x, y, layer).begin());
  };
  for (int layer = 0; layer < image.layers(); ++layer)
    for (int i = 0; i <= last; ++i) {
      fill(i, 0, layer);
      fill(i, last, layer);
      fill(0, i, layer);
      fill(last, i, layer);
    }
}

}  // namespace weft
