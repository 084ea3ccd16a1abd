#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// `laf`: a diffuse albedo and k generalised cosine lobes of light and view (Lafortune's model,
/// [Meseth 2004] [14], [Bosserhoff 2003] 3.2): rho_d + sum_j a_j (c_j . (lx vx, ly vy, lz vz))^n_j,
/// the dot product clamped at 0, for all views at once. `slaf`: the same times a view factor T_v, a
/// number a measured view (M [5], Daubert et al. 2001).
///
/// Lafortune's (C . P)^n has the amplitude a = |C|^n inside, which overflows in half precision.
/// Stored instead are the amplitude, the axes c with a largest |cx|, |cy|, cz of 1 as two numbers
/// (packedLafAxes()), and the exponent: four numbers a lobe, one RGBA texel. Since |lx vx| + |ly
/// vy| + |lz vz| <= 1, the base never exceeds 1 above the horizon, and a lobe never its amplitude.
class LafModel : public ReflectanceModel {
 public:
  static constexpr int kMaximumLobes = 10;

  /// `laf` and `slaf`.
  static std::vector<ModelType> types();
  LafModel(ModelOptions options, bool hasViewFactor);

  LayerDirections layerDirections() const override;
  std::vector<std::string> sharedParameters() const override;
  std::vector<std::string> layerParameters() const override;
  float evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                 glm::vec3 view) const override;
  bool integratesEnvironments() const override { return true; }
  glm::vec3 underEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3 view,
                             const EnvironmentIntegrals& light) const override;
  std::string shaderFile() const override { return "laf.glsl"; }
  std::map<std::string, std::string> shaderDefines() const override;

 private:
  int lobes_;
  bool hasViewFactor_;
};

/// Axes with max(|x|, |y|, z) = 1 from two numbers (p, q): with s = max(1, |p|, |q|) they are (p /
/// s, q / s, 2 - s). So +-1 and 0 are exact in any precision.
glm::vec3 lafAxes(glm::vec2 packed);
/// The inverse.
glm::vec2 packedLafAxes(glm::vec3 axes);

}  // namespace weft
