#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace weft {

/// The vertices of makeDrapedCloth(): a square grid, row by row.
std::vector<glm::vec3> dropCloth();

}  // namespace weft
