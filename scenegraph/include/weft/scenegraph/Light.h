#pragma once

#include <glm/vec3.hpp>
#include <limits>

#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// What lights a scene from its node's place. The members of all kinds are read anew in each frame.
class Light : public NodeCore {
 public:
  /// Whether opaque things between it and a surface keep its light off, for eight lights of a
  /// scene; an environment's never is kept off.
  bool castsShadow = false;
};

/// Light from its node's origin in all directions: irradiance = intensity / distance^2. glTF:
/// candela.
class PointLight : public Light {
 public:
  explicit PointLight(glm::vec3 candela) : intensity(candela) {}

  glm::vec3 intensity;  ///< RGB, linear
  /// World units; the light fades out towards it, as glTF's specification says how, and ends there.
  float range = std::numeric_limits<float>::infinity();
};

/// Light from its node's origin in a cone around its -Z axis, as in glTF.
class SpotLight : public Light {
 public:
  /// Full intensity up to `inner`, none from `outer` on: angles to the axis in radians, inner <
  /// outer <= pi/2.
  explicit SpotLight(glm::vec3 candela, float inner = 0.0f, float outer = 0.7853982f)
      : intensity(candela), innerAngle(inner), outerAngle(outer) {}

  glm::vec3 intensity;  ///< RGB, linear
  float innerAngle;
  float outerAngle;
  float range = std::numeric_limits<float>::infinity();  ///< as PointLight's
};

/// Parallel light along its node's -Z axis, as in glTF: `irradiance` (lux) on a surface that faces
/// it. A white surface then shows irradiance / pi.
class DirectionalLight : public Light {
 public:
  explicit DirectionalLight(glm::vec3 lux) : irradiance(lux) {}

  glm::vec3 irradiance;  ///< RGB, linear
};

}  // namespace weft
