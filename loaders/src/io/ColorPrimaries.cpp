#include "ColorPrimaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "weft/core/Contract.h"

namespace weft {
namespace {

constexpr double kSame = 1e-3;

glm::dvec3 xyz(glm::dvec2 xy) {
  return {xy.x, xy.y, 1.0 - xy.x - xy.y};
}

bool isRec709(const ColorPrimaries& primaries) {
  const ColorPrimaries rec709;
  const auto same = [](glm::dvec2 a, glm::dvec2 b) {
    return std::abs(a.x - b.x) < kSame && std::abs(a.y - b.y) < kSame;
  };
  return same(primaries.red, rec709.red) && same(primaries.green, rec709.green) &&
         same(primaries.blue, rec709.blue) && same(primaries.white, rec709.white);
}

/// White of luminance 1.
glm::dvec3 whiteOf(const ColorPrimaries& primaries) {
  return xyz(primaries.white) / primaries.white.y;
}

/// Linear RGB to CIE XYZ.
glm::dmat3 toXyz(const ColorPrimaries& primaries) {
  const glm::dmat3 directions(xyz(primaries.red), xyz(primaries.green), xyz(primaries.blue));
  const glm::dvec3 amounts = glm::inverse(directions) * whiteOf(primaries);
  return glm::dmat3(directions[0] * amounts.x, directions[1] * amounts.y, directions[2] * amounts.z);
}

/// XYZ under one white to what looks the same under another.
glm::dmat3 adaptation(glm::dvec3 from, glm::dvec3 to) {
  const glm::dmat3 bradford(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367, 1.0296);
  const glm::dvec3 scale = (bradford * to) / (bradford * from);
  const glm::dmat3 scaled(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
  return glm::inverse(bradford) * scaled * bradford;
}

}  // namespace

std::optional<glm::mat3> toRec709(const ColorPrimaries& primaries) {
  if (isRec709(primaries)) return glm::mat3(1.0f);
  const ColorPrimaries rec709;
  const glm::mat3 matrix(glm::inverse(toXyz(rec709)) * adaptation(whiteOf(primaries), whiteOf(rec709)) *
                         toXyz(primaries));
  // A factor of a hundred is beyond all colour spaces: the primaries lie nearly on a line.
  for (int i = 0; i < 9; ++i)
    if (const float value = matrix[i / 3][i % 3]; !(std::abs(value) < 100.0f)) return std::nullopt;
  return matrix;
}

void transformColors(FloatImage& image, const glm::mat3& matrix) {
  WEFT_EXPECT(image.channelCount() == 3, "colours have three channels");
  if (matrix == glm::mat3(1.0f)) return;
  const auto values = image.values();
  for (std::size_t i = 0; i < values.size(); i += 3) {
    const glm::vec3 rgb = matrix * glm::vec3(values[i], values[i + 1], values[i + 2]);
    for (int c = 0; c < 3; ++c) values[i + static_cast<std::size_t>(c)] = rgb[c];
  }
  image.setPrecision(Precision::Float);
}

}  // namespace weft
