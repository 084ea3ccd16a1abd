#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "weft/core/FloatImage.h"

namespace weft {

/// One lobe of light, as a prefiltered environment answers it: the average radiance over (direction . l)^n,
/// times `amount`.
struct CosineLobe {
  float amount = 0.0f;
  glm::vec3 direction{0, 0, 1};
  float exponent = 1.0f;
};

/// Replaces the part above the horizon of a lobe (t.l)^n, times n.l, by the one lobe of the same integral,
/// mean direction and spread. Paper M (5.2) takes the lobe as it is, times n.t, which adds light from below
/// the horizon and forgets that n.l leans towards the normal.
///
/// In an environment without detail this is exact. A table over the cosine between t and the normal and over
/// the exponent. Immutable, thread safe.
class CosineLobeTable {
 public:
  CosineLobeTable();

  static constexpr float kLargestExponent = 256.0f;

  /// The integral of (t.l)^n (normal.l) over both hemispheres, divided by pi, as a lobe; unit vectors,
  /// exponents from 1.
  CosineLobe at(glm::vec3 t, float exponent, glm::vec3 normal) const;

  /// What the shader looks up: columns are cosines from -1 to 1, rows log2 of the exponent from 0 to 8, first
  /// and last value in the middle of a texel. Channels: the integral over that of (t.l)^n; by how much of the
  /// normal's part across t the direction moves; log2 of the new exponent.
  const FloatImage& image() const { return image_; }

 private:
  FloatImage image_;
};

/// What GGX microfacets reflect of light that is the same from everywhere (the split sum of Karis 2013):
/// F0 x + y for a surface that reflects F0 head-on and 1 at grazing angles, shadowing as in ggx.glsl.
/// Immutable, thread safe.
class MicrofacetTable {
 public:
  MicrofacetTable();

  glm::vec2 at(float cosineToView, float roughness) const;

  /// Columns: the cosine from 0 to 1; rows: the roughness from 0 to 1; first and last value in the middle of
  /// a texel. Channels x, y.
  const FloatImage& image() const { return image_; }

 private:
  FloatImage image_;
};

}  // namespace weft
