#include "weft/reflectance/CosineLobe.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {

CosineLobe lobeAboveHorizon(glm::vec3 t, float exponent, glm::vec3 normal) {
  // n.l of the lobe's directions: c times what they have of t, plus what they have across it, of
  // variance 1 / (n + 3) along each axis. Of a normal distribution of that mean, the mean of max(0,
  // n.l) is nearly half of mean + root; the other factors bring all three numbers close to their
  // integrals for exponents from 1.
  const float c = glm::dot(t, normal);
  const float narrow = 1.0f / (exponent + 2.0f);
  const float mean = c * (1.0f - narrow);
  const float spread = 0.6366f * std::max(1.0f - c * c, 0.0f) * narrow * (1.0f - 0.42f * narrow);
  const float squared = mean * mean + spread;
  const float inverse = 1.0f / std::sqrt(squared);
  const float root = squared * inverse;
  const float cut = spread * inverse * inverse;  // 1 where half of the lobe is below the horizon
  const float facing =
      std::max(0.5f * (mean + root) - 0.25f * root * cut * (1.0f - cut) * (1.0f - 0.5f * cut), 0.0f);
  const float shift = narrow * inverse * (1.0f + 0.85f * narrow * cut * cut) *
                      (mean < 0.0f ? 1.0f + 1.85f * (1.0f - cut) : 1.0f);
  const float below = 0.5f - 0.5f * mean * inverse;
  return {2.0f / (exponent + 1.0f) * facing, glm::normalize(t + shift * (normal - c * t)),
          (exponent + 1.0f) * std::exp2(below * (1.05f + 1.37f * narrow))};
}

}  // namespace weft
