#pragma once

#include <glm/vec2.hpp>

#include "weft/core/FloatImage.h"

namespace weft {

/// What GGX microfacets reflect of light that is the same from everywhere (the split sum of Karis
/// 2013): F0 x + y for a surface that reflects F0 head-on and 1 at grazing angles, shadowing as in
/// ggx.glsl. Immutable, thread safe.
class MicrofacetTable {
 public:
  MicrofacetTable();

  glm::vec2 at(float cosineToView, float roughness) const;

  /// Columns: the cosine from 0 to 1; rows: the roughness from 0 to 1; first and last value in the
  /// middle of a texel. Channels x, y.
  const FloatImage& image() const { return image_; }

 private:
  FloatImage image_;
};

}  // namespace weft
