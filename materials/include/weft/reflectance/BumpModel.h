#pragma once

#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// `bump`: an ordinary bump-mapped surface, the baseline of [Meseth 2004] fig. 4: a normal, an
/// albedo and a roughness a texel, the same for all views.
///
/// The formula is glTF's for a dielectric (appendix B: Lambertian below GGX with Smith's
/// height-correlated shadowing, F0 = .04), so base colour times albedo, normal and roughness are
/// what a metallic-roughness material needs. But here the base colour, whose luminance is 1, tints
/// the specular part too. The normal is stored in parabolic coordinates. The value contains the
/// cosine, of the texel's own normal.
class BumpModel : public ReflectanceModel {
 public:
  /// `bump`; without the option `color`: the colour channels of a texel have one normal.
  static std::vector<ModelType> types();
  using ReflectanceModel::ReflectanceModel;

  LayerDirections layerDirections() const override { return LayerDirections::None; }
  bool containsCosine() const override { return true; }
  std::vector<std::string> sharedParameters() const override { return {"albedo", "px", "py", "roughness"}; }
  float evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                 glm::vec3 view) const override;
  bool integratesEnvironments() const override { return true; }
  glm::vec3 underEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3 view,
                             const EnvironmentIntegrals& light) const override;
  std::string shaderFile() const override { return "bump.glsl"; }
};

}  // namespace weft
