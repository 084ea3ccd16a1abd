#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "PatchSource.h"

namespace weft {

/// Smooths the jumps of a surface, a torus of texels of a source: along them, texels are replaced
/// by others that differ less from what their four neighbours expect beside them: by what goes on
/// from one of those, or is similar to that. Squares are summed, so that a large jump becomes some
/// small ones.
void polishSeams(const PatchSource& source, glm::ivec2 size, std::span<glm::ivec2> texels, int rounds);

}  // namespace weft
