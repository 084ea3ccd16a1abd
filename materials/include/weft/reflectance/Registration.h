#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace weft {

/// How the texels of a surface in relief move with the view: what is seen of it at a place x is its
/// texel x + height * reliefTangent(view) + deviation. Deviations are interpolated between those of
/// the measured views, of which each makes that whole.
///
/// In texels; x along columns, y up, so that a texel's row is its row minus y.
struct Registration {
  float height = 0.0f;                ///< of the surface above the plane of the texels
  std::vector<glm::vec2> deviations;  ///< a measured view; empty where nothing moves

  bool empty() const { return deviations.empty(); }
};

/// How far a surface at height 1 moves with a view.
inline glm::vec2 reliefTangent(glm::vec3 view) {
  return glm::vec2(view) / std::max(view.z, 1e-3f);
}

}  // namespace weft
