#pragma once

#include <glm/vec3.hpp>
#include <string_view>

#include "weft/core/Result.h"

namespace weft {

/// How stored values relate to linear ones. Everything in memory is linear unless its name says
/// "stored".
enum class Encoding {
  Linear,
  Gamma22,  ///< stored = linear^(1/2.2): UBO2003, ATRIUM's JPEGs
  Srgb,     ///< IEC 61966-2-1: UTIA's PNGs, glTF's colour textures, every PNG that Weft writes
};

/// "linear", "gamma2.2" or "srgb": the names in manifests and reports.
std::string_view name(Encoding encoding);
Result<Encoding> encodingFromName(std::string_view name);

/// Stored to linear; values above 1 follow the same curve, negative ones become 0.
float decode(Encoding encoding, float stored);
/// Linear to stored; values above 1 follow the same curve, negative ones become 0.
float encode(Encoding encoding, float linear);
glm::vec3 decode(Encoding encoding, glm::vec3 stored);
glm::vec3 encode(Encoding encoding, glm::vec3 linear);

/// Rec. 709 weights. Applied to encoded RGB it gives "stored luminance", which is not the encoding
/// of linear luminance.
constexpr glm::vec3 kLuminanceWeights{0.2126f, 0.7152f, 0.0722f};
inline float luminance(glm::vec3 rgb) {
  return kLuminanceWeights.x * rgb.x + kLuminanceWeights.y * rgb.y + kLuminanceWeights.z * rgb.z;
}

}  // namespace weft
