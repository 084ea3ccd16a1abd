#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "weft/core/Color.h"
#include "weft/core/Result.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// What is the same for every texel of a fit.
struct FitProblem {
  std::vector<glm::vec3> views;  ///< of the samples, unit, tangent frame
  std::vector<glm::vec3> lights;
  bool cosineInModel = false;  ///< the model contains n.l; else it is multiplied by it
  bool weighted = true;        ///< false: all weights are equal, plain least squares
  std::shared_ptr<const ReflectanceModel> model;
  Encoding encoding = Encoding::Linear;  ///< of the stored samples
  int width = 1;                         ///< of the field, in texels
  int height = 1;
};

/// Fits the numbers of one texel to its samples: one class a model whose texels share nothing.
/// Thread safe.
class TexelFitter {
 public:
  virtual ~TexelFitter() = default;

  /// Fits one colour channel: minimises the sum of (weight (target - n.l RF))^2, without n.l where
  /// it is in the model. `targets` and `weights` are `[view][light]`, finite, weights >= 0 (all may
  /// be 0). Fills the model's shared numbers and `layers[layer][number]`; every number written is
  /// finite.
  virtual void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
                   std::span<float> layers) const = 0;
};

}  // namespace weft
