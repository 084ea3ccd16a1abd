#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

namespace weft {

/// What an environment gives to one surface: the integrals from which models are shaded ([Meseth
/// 2004] 5.2), in the surface's tangent frame, and in units of a white surface, which shows 1 in an
/// environment of 1. The CPU reference of shaders/environment.glsl; who implements it decides how
/// exact the integrals are.
class EnvironmentIntegrals {
 public:
  virtual ~EnvironmentIntegrals() = default;

  /// The integral of radiance (normal.l) / pi over the normal's hemisphere.
  virtual glm::vec3 diffuse(glm::vec3 normal) const = 0;
  /// The integral of radiance (t.l)^exponent l.z / pi above the surface; t of unit length.
  virtual glm::vec3 lobe(glm::vec3 t, float exponent) const = 0;
  /// The integrals of radiance w l.z / pi above the surface, for w = xx, yy, xy, x, y, 1 of l.
  virtual std::array<glm::vec3, 6> moments() const = 0;
  /// What GGX microfacets of this normal, F0 and F90 = 1 show to `view`.
  virtual glm::vec3 glossy(glm::vec3 normal, glm::vec3 view, float roughness, float f0) const = 0;
  /// How much light of 1 they would reflect.
  virtual float glossyShare(glm::vec3 normal, glm::vec3 view, float roughness, float f0) const = 0;
  /// The average radiance over (t.l)^exponent.
  virtual glm::vec3 average(glm::vec3 t, float exponent) const = 0;
};

/// Measured lights as the nodes of an integral over the hemisphere: for formulas that cannot be
/// integrated otherwise (light fields, fits of stored values, fits that contain n.l).
struct LightQuadrature {
  struct Node {
    glm::vec3 light;
    /// the integral of n.l / pi over the directions to which no other node is nearer
    float weight;
  };
  std::vector<Node> nodes;  ///< weights have the sum 1, so that a white surface stays white
  float exponent = 1.0f;    ///< of lobes as wide as the nodes are apart

  /// Of the lights at least 6 degrees above the horizon, because values are divided by n.l; of the
  /// normal where there are none.
  static LightQuadrature create(const std::vector<glm::vec3>& lights);
};

}  // namespace weft
