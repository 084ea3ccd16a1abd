#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace weft {

/// The largest exponent that a lobe may have without hiding between lights: halfway between the two
/// neighbours farthest apart it has at least half its height (81 for UBO2003).
float sharpestExponent(std::span<const glm::vec3> lights);

}  // namespace weft
