#pragma once

#include <cstddef>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double2.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "weft/scenegraph/Material.h"
#include "weft/scenegraph/Node.h"

namespace weft {

/// All triangles of a scene that one material is drawn on.
struct MaterialSurface {
  std::shared_ptr<const Material> material;
  std::size_t triangles = 0;
  double area = 0.0;                                            ///< in units of the scene, squared
  double textureArea = 0.0;                                     ///< the same in texture coordinates
  glm::dvec2 minimum{std::numeric_limits<double>::infinity()};  ///< of texture coordinates
  glm::dvec2 maximum{-std::numeric_limits<double>::infinity()};

  /// How long a unit of texture coordinates is in the scene, on average; 0 where there are none.
  double unitLength() const;
};

/// The surfaces of all materials, in the order in which a walk meets them.
///
/// With `toClip`, a camera's projection times its view, only what is within its picture, from both
/// sides, hidden or not. Lines and points have no surface.
std::vector<MaterialSurface> surfacesOf(const Node& root, const std::optional<glm::dmat4>& toClip = {});

}  // namespace weft
