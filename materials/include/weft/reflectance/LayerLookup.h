#pragma once

#include "weft/core/FloatImage.h"
#include "weft/core/HemisphereTriangulation.h"

namespace weft {

/// The tables with which a shader finds the measured views around a direction in two fetches
/// ([Meseth 2004] 5.1, shaders/layer_lookup.glsl).
struct LayerLookup {
  /// A cube map whose texels hold the number of the triangle at their centre: six layers, one
  /// channel, faces +X -X +Y -Y +Z -Z.
  FloatImage triangleOfDirection;
  /// A row a triangle, a texel a corner k: the weight row (xyz), and 1 + the view's index (w),
  /// negative where the edge opposite of the corner lies on the hull.
  FloatImage triangles;

  static LayerLookup create(const HemisphereTriangulation& triangulation, int cubeSize = 128);

  /// What the shader computes: exact inside a triangle; where a cube texel straddles an edge its
  /// centre's triangle decides, and negative weights are clamped.
  DirectionWeights locate(const HemisphereTriangulation& triangulation, glm::vec3 direction) const;
};

}  // namespace weft
