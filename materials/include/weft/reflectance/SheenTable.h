#pragma once

#include "weft/core/FloatImage.h"

namespace weft {

/// What a white sheen reflects of light that is the same from everywhere: its directional albedo,
/// by which glTF's sheen darkens what lies below it (KHR_materials_sheen). Immutable, thread safe.
///
/// The sheen is the one of Conty and Kulla 2017: D = (2 + 1/r) sin(h)^(1/r) / (2 pi), with the
/// shadowing that they fitted to it; r is the roughness squared. GLSL: shaders/sheen.glsl.
class SheenTable {
 public:
  /// Below this roughness sheen counts as that smooth.
  static constexpr float kSmoothest = 0.07f;

  SheenTable();

  float at(float cosineToView, float roughness) const;

  /// Columns: the cosine from 0 to 1; rows: the roughness from 0 to 1; first and last value in the
  /// middle of a texel.
  const FloatImage& image() const { return image_; }

 private:
  FloatImage image_;
};

}  // namespace weft
