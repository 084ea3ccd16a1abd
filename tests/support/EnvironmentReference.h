#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "weft/reflectance/Environment.h"
#include "weft/reflectance/EnvironmentIntegrals.h"
#include "weft/reflectance/MicrofacetTable.h"

namespace weft {

/// How the light of a lobe is approximated.
enum class LobeMethod {
  True,          ///< not at all: (t.l)^n n.l above the surface
  Paper,         ///< [Meseth 2004] 5.2: all light of (t.l)^n, times n.t
  PaperRounded,  ///< the same with n rounded to 2^(i/2), i = 0..10
  /// n.t times the lobe n + 1, leant towards the normal by 1 / ((n + 1) n.t): its first order
  Shifted,
  Fitted,  ///< lobeAboveHorizon(), what shaders do
};

/// Integrals over an environment as sums over all of its texels: the reference of what is
/// prefiltered, and of what approximations cost. An environment of some thousand texels is quick.
/// Immutable, thread safe.
class EnvironmentReference {
 public:
  explicit EnvironmentReference(const Environment& environment);

  /// The radiance that a surface shows whose value (n.l included; 1 is white) for light from a
  /// direction of its tangent frame is given. `axes`: its tangent, bitangent and normal.
  glm::vec3 shown(const glm::mat3& axes, const std::function<glm::vec3(glm::vec3 light)>& value) const;

  /// The environment as a surface's model asks for it, its lobes by one of the methods. Refers to
  /// this.
  class Light : public EnvironmentIntegrals {
   public:
    Light(const EnvironmentReference& reference, const glm::mat3& axes, LobeMethod method)
        : reference_(reference), axes_(axes), method_(method) {}

    glm::vec3 diffuse(glm::vec3 normal) const override;
    glm::vec3 lobe(glm::vec3 t, float exponent) const override;
    std::array<glm::vec3, 6> moments() const override;
    glm::vec3 glossy(glm::vec3 normal, glm::vec3 view, float roughness, float f0) const override;
    float glossyShare(glm::vec3 normal, glm::vec3 view, float roughness, float f0) const override;
    glm::vec3 average(glm::vec3 t, float exponent) const override;

   private:
    const EnvironmentReference& reference_;
    glm::mat3 axes_;
    LobeMethod method_;
  };

 private:
  /// Radiance times kernel times solid angle, over all texels; directions in the environment.
  template <class Kernel>
  glm::vec3 sum(const Kernel& kernel) const;

  struct Texel {
    glm::vec3 direction;
    glm::vec3 light;  ///< radiance times solid angle
  };
  std::vector<Texel> texels_;
  MicrofacetTable microfacets_;
};

}  // namespace weft
