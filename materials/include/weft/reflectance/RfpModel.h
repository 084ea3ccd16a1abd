#pragma once

#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// `rfp`: a biquadratic polynomial of the light's x and y for every view, times the texel's base colour
/// (paper M 4.1, B eq. 1-4): a0 lx^2 + a1 ly^2 + a2 lx ly + a3 lx + a4 ly + a5.
class RfpModel : public ReflectanceModel {
 public:
  static Result<std::shared_ptr<const ReflectanceModel>> create(const ModelDescription& description);

  ModelDescription description() const override;
  std::vector<std::string> sharedChannels() const override;
  std::vector<std::string> viewChannels() const override;
  glm::vec3 evaluate(std::span<const float> shared, std::span<const float> view,
                     glm::vec3 light) const override;
  std::string shaderFile() const override { return "rfp.glsl"; }
};

}  // namespace weft
