#pragma once

#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// `rfp`: a biquadratic polynomial of the light's x and y for every view, times the texel's base
/// colour ([Meseth 2004] 4.1, [Bosserhoff 2003] eq. 1-4): a0 lx^2 + a1 ly^2 + a2 lx ly + a3 lx + a4
/// ly + a5.
///
/// `lfp`: the same of the view's x and y for every light. `ptm`: the same of one view, fitted as
/// polynomial texture maps are, by plain least squares.
class RfpModel : public ReflectanceModel {
 public:
  /// `rfp`, `lfp` and `ptm`.
  static std::vector<ModelType> types();
  RfpModel(ModelOptions options, LayerDirections layerDirections)
      : ReflectanceModel(std::move(options)), layerDirections_(layerDirections) {}

  LayerDirections layerDirections() const override { return layerDirections_; }
  std::vector<std::string> layerParameters() const override;
  float evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                 glm::vec3 view) const override;
  void evaluateLights(std::span<const float> shared, std::span<const float> layer,
                      std::span<const glm::vec3> lights, glm::vec3 view,
                      std::span<float> values) const override;
  bool integratesEnvironments() const override { return layerDirections_ == LayerDirections::Views; }
  glm::vec3 underEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3 view,
                             const EnvironmentIntegrals& light) const override;
  std::string shaderFile() const override { return "rfp.glsl"; }

 private:
  LayerDirections layerDirections_;
};

}  // namespace weft
