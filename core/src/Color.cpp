#include "weft/core/Color.h"

#include <algorithm>
#include <cmath>

namespace weft {

std::string_view name(Encoding encoding) {
  switch (encoding) {
    case Encoding::Linear:
      return "linear";
    case Encoding::Gamma22:
      return "gamma2.2";
    case Encoding::Srgb:
      return "srgb";
  }
  return "linear";
}

Result<Encoding> encodingFromName(std::string_view text) {
  for (Encoding encoding : {Encoding::Linear, Encoding::Gamma22, Encoding::Srgb})
    if (text == name(encoding)) return encoding;
  return fail("unknown encoding '" + std::string(text) + "'", {}, "linear, gamma2.2 or srgb");
}

float decode(Encoding encoding, float stored) {
  const float value = std::max(stored, 0.0f);
  switch (encoding) {
    case Encoding::Linear:
      return value;
    case Encoding::Gamma22:
      return std::pow(value, 2.2f);
    case Encoding::Srgb:
      return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
  }
  return value;
}

float encode(Encoding encoding, float linear) {
  const float value = std::max(linear, 0.0f);
  switch (encoding) {
    case Encoding::Linear:
      return value;
    case Encoding::Gamma22:
      return std::pow(value, 1.0f / 2.2f);
    case Encoding::Srgb:
      return value <= 0.0031308f ? value * 12.92f : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
  }
  return value;
}

glm::vec3 decode(Encoding encoding, glm::vec3 stored) {
  return {decode(encoding, stored.x), decode(encoding, stored.y), decode(encoding, stored.z)};
}

glm::vec3 encode(Encoding encoding, glm::vec3 linear) {
  return {encode(encoding, linear.x), encode(encoding, linear.y), encode(encoding, linear.z)};
}

}  // namespace weft
