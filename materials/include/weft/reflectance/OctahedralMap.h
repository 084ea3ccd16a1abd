#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "weft/core/FloatImage.h"

namespace weft {

/// All directions on a square, so that one bilinear fetch reads what depends on a direction: the
/// octahedron |x| + |y| + |z| = 1 seen from +z, its lower half folded outwards
/// (shaders/environment.glsl has the same).
///
/// An image of it has a border of one texel that repeats what lies beyond its folded edges.
struct OctahedralMap {
  int size = 0;  ///< texels a side without the border

  int imageSize() const { return size + 2; }
  /// The direction of the middle of texel (x, y), 0 <= x, y < size.
  glm::vec3 direction(int x, int y) const;
  /// The texel, without the border, that a texel of the bordered image repeats.
  glm::ivec2 source(int imageX, int imageY) const;
  /// Makes the border of every layer of a bordered image.
  void fillBorder(FloatImage& image) const;

  /// -1..1 a side; the direction need not be of unit length.
  static glm::vec2 place(glm::vec3 direction);
  static glm::vec3 direction(glm::vec2 place);
};

}  // namespace weft
