#pragma once

#include <Eigen/Core>

#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Fits `bump` by photometric stereo: the measured view nearest to the pole under all its lights.
///
/// Minimises absolute errors and starts from the lights of middling brightness, so that neither
/// shadows nor highlights bend the normal.
class BumpFitter : public TexelFitter {
 public:
  /// Fails where the lights do not determine a normal: fewer than six above the horizon, or all in
  /// one plane with the texel.
  static Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem);

  void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
           std::span<float> layers) const override;

 private:
  struct Surface;
  /// Above what errors count as those of outliers.
  struct ScaleRange {
    float first, last;
  };
  explicit BumpFitter(const FitProblem& problem);

  Surface lambertian(const Eigen::ArrayXf& samples) const;
  Surface improved(const Eigen::ArrayXf& samples, Surface from, ScaleRange scales, int iterations) const;
  Eigen::Vector4f bounded(Eigen::Vector4f numbers, float brightest) const;
  Eigen::ArrayXf valuesOf(const Eigen::Vector4f& numbers) const;

  std::shared_ptr<const ReflectanceModel> model_;
  std::size_t lightCount_ = 0;
  std::size_t view_ = 0;  ///< the view nearest to the pole
  glm::vec3 viewDirection_{};
  std::vector<std::size_t> index_;  ///< of the lights above the horizon
  std::vector<glm::vec3> lights_;   ///< their directions
  float smoothest_ = 0.0f;          ///< roughness: a narrower highlight could hide between lights
};

}  // namespace weft
