#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace weft {

/// What shines on a texel beside the components of `loom`: one lobe of microfacets (GGX) about a
/// normal of its own. The CPU reference of shaders/gloss.glsl.
///
///     RF = pi amount D(n.h) V(l.z, v.z)      without n.l
///
/// D is GGX's distribution of normals, V Smith's height-correlated shadowing (shaders/ggx.glsl), of
/// the surface as a whole: so no light grazes the texel's own normal, where a small error of that
/// would be a large one of the value. There is no Fresnel factor.
struct GlossLobe {
  static constexpr std::size_t kNumbers = 4;
  /// The longest tilt: 53 degrees from the pole.
  static constexpr float kSteepest = 0.5f;

  glm::vec2 tilt{0.0f};  ///< parabolic coordinates of the normal
  float alpha = 0.5f;    ///< GGX's, the square of the roughness
  float amount = 0.0f;   ///< the share of light that is mirrored, about

  /// From the numbers that a field keeps, in -1..1: tilt / kSteepest, and the square roots of the
  /// others. Any are allowed.
  static GlossLobe from(std::span<const float> numbers);
  std::array<float, kNumbers> numbers() const;
  /// With numbers as the bytes that a GPU keeps of them.
  GlossLobe rounded() const;

  glm::vec3 normal() const;
  /// RF for directions above the horizon.
  float evaluate(glm::vec3 light, glm::vec3 view) const;
};

}  // namespace weft
