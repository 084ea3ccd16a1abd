#pragma once

#include <glm/vec3.hpp>

namespace weft {

/// ka + kd l.z + ks h.z^exponent, h between light and view: what all texels of `lod` have in common
/// ([Ma 2005] eq. 5).
struct PhongMean {
  float ambient = 0.0f;
  float diffuse = 0.0f;
  float specular = 0.0f;
  float exponent = 1.0f;

  /// Of unit directions, tangent frame.
  float value(glm::vec3 light, glm::vec3 view) const;
};

}  // namespace weft
