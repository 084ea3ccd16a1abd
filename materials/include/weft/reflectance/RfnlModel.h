#pragma once

#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// `rfnl`: a diffuse albedo and k cosine lobes for every view, times the texel's base colour
/// ([Meseth 2004] eq. 1): rho_d(x) + sum_j a_j (m_j . l)^n_j, the dot product clamped at 0.
///
/// [Meseth 2004]'s rho_s,v (t_j . l)^n_j has one parameter too many, and |t|^n overflows in half
/// precision. Stored instead are the amplitude a_j = rho_s |t_j|^n_j, the unit direction m_j in
/// parabolic coordinates, which no rounding can make longer or shorter, and the exponent: four
/// numbers a lobe, one RGBA texel.
///
/// `lfnl`: the same of the view direction for every light.
class RfnlModel : public ReflectanceModel {
 public:
  static constexpr int kMaximumLobes = 4;

  /// `rfnl` and `lfnl`.
  static std::vector<ModelType> types();
  RfnlModel(ModelOptions options, LayerDirections layerDirections);

  LayerDirections layerDirections() const override { return layerDirections_; }
  std::vector<std::string> sharedParameters() const override;
  std::vector<std::string> layerParameters() const override;
  float evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                 glm::vec3 view) const override;
  void evaluateLights(std::span<const float> shared, std::span<const float> layer,
                      std::span<const glm::vec3> lights, glm::vec3 view,
                      std::span<float> values) const override;
  bool integratesEnvironments() const override { return layerDirections_ == LayerDirections::Views; }
  glm::vec3 underEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3 view,
                             const EnvironmentIntegrals& light) const override;
  bool prepareForEnvironments(std::span<float> layer) const override;
  std::string shaderFile() const override { return "rfnl.glsl"; }
  std::map<std::string, std::string> shaderDefines() const override;

 private:
  float diffuseAlbedoOf(std::span<const float> shared, std::span<const float> layer) const {
    return ownDiffuseAlbedo_ ? layer.back() : shared[0];
  }

  LayerDirections layerDirections_;
  int lobes_;
  bool ownDiffuseAlbedo_;
};

}  // namespace weft
