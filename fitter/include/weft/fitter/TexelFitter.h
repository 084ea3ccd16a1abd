#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

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
};

/// Fits the numbers of one texel to its samples: one class a model. Thread safe.
class TexelFitter {
 public:
  virtual ~TexelFitter() = default;

  /// Fits one colour channel: minimises the sum of (weight (target - n.l RF))^2, without n.l where it is in
  /// the model. `targets` and `weights` are `[view][light]`, finite, weights >= 0 (all may be 0). Fills the
  /// model's shared numbers and `layers[layer][number]`; every number written is finite.
  virtual void fit(std::span<const float> targets, std::span<const float> weights, std::span<float> shared,
                   std::span<float> layers) const = 0;
};

/// Makes fitters by model name; the counterpart of ModelRegistry.
class FitterRegistry {
 public:
  using Factory = Result<std::unique_ptr<TexelFitter>> (*)(const FitProblem&);

  static FitterRegistry builtin();
  void add(std::string model, Factory factory);
  /// Fails on an unknown model and on measurements that do not determine its numbers.
  Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem) const;

 private:
  std::vector<std::pair<std::string, Factory>> factories_;
};

}  // namespace weft
