#pragma once

#include <glm/vec3.hpp>

namespace weft {

/// One lobe of light, as a prefiltered environment answers it: `amount` times the average radiance
/// over (direction . l)^n.
struct CosineLobe {
  float amount = 0.0f;
  glm::vec3 direction{0, 0, 1};
  float exponent = 1.0f;
};

/// The lobe that stands for the part of (t.l)^n above the horizon, times n.l: of the same integral
/// (divided by pi), mean direction and spread. [Meseth 2004] (5.2) takes the lobe as it is, times
/// n.t, which adds light from below the horizon and forgets that n.l leans towards the normal.
///
/// In closed form, as if directions around t were normally distributed: in an environment without
/// detail it is within 3 % of the truth. Unit vectors, exponents from 1. GLSL:
/// shaders/environment.glsl.
CosineLobe lobeAboveHorizon(glm::vec3 t, float exponent, glm::vec3 normal);

}  // namespace weft
