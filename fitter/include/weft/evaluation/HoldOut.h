#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace weft {

/// Which directions a fit leaves out to be tested on them: about every `every`th, none for 0.
///
/// The rule is fixed: directions are walked ring by ring (bands of 15 degrees) and by azimuth in
/// each, and every `every`th is left out; never one within 7.5 degrees of the pole, nor the only
/// one of its ring. `every` is 0 or at least 2, so that no ring is left out as a whole.
std::vector<bool> heldOut(std::span<const glm::vec3> directions, int every);

}  // namespace weft
