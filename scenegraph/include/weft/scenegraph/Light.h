#pragma once

#include <glm/vec3.hpp>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Light from its node's origin in all directions: irradiance = intensity / distance^2. glTF: candela.
class PointLight : public NodeCore {
 public:
  explicit PointLight(glm::vec3 candela) : intensity(candela) {}

  glm::vec3 intensity;  ///< RGB, linear
};

/// Parallel light along its node's -Z axis, as in glTF: `irradiance` (lux) on a surface that faces it. A
/// white surface then shows irradiance / pi.
class DirectionalLight : public NodeCore {
 public:
  explicit DirectionalLight(glm::vec3 lux) : irradiance(lux) {}

  glm::vec3 irradiance;  ///< RGB, linear
};

}  // namespace weft
