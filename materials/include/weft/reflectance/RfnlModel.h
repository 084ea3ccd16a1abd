#pragma once

#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// `rfnl`: a diffuse albedo and k cosine lobes for every view, times the texel's base colour (paper M eq. 1):
/// rho_d(x) + sum_j a_j (m_j . l)^n_j, the dot product clamped at 0.
///
/// M's rho_s,v (t_j . l)^n_j has one parameter too many, and |t|^n overflows in half precision. Stored
/// instead are the amplitude a_j = rho_s |t_j|^n_j, the unit direction m_j in parabolic coordinates, which no
/// rounding can make longer or shorter, and the exponent: four numbers a lobe, one RGBA texel.
class RfnlModel : public ReflectanceModel {
 public:
  static constexpr int kMaximumLobes = 4;

  /// 1 to kMaximumLobes lobes.
  static Result<std::shared_ptr<const ReflectanceModel>> create(const ModelDescription& description);
  explicit RfnlModel(ModelDescription description) : description_(std::move(description)) {}

  ModelDescription description() const override { return description_; }
  std::vector<std::string> sharedChannels() const override;
  std::vector<std::string> viewChannels() const override;
  glm::vec3 evaluate(std::span<const float> shared, std::span<const float> view,
                     glm::vec3 light) const override;
  std::string shaderFile() const override { return "rfnl.glsl"; }
  std::map<std::string, std::string> shaderDefines() const override;

 private:
  bool ownDiffuseAlbedo() const { return description_.diffuseAlbedo == DiffuseAlbedo::PerView; }

  ModelDescription description_;
};

}  // namespace weft
