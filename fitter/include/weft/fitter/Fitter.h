#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/fitter/FitErrors.h"
#include "weft/io/BtfSource.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// A rectangle of texels; row 0 is the top.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

/// How a fit is made. Every default is what most users want.
struct FitOptions {
  ModelDescription model;
  Precision precision = Precision::Half;  ///< of the stored parameters; half changes eps by less than 0.0001
  /// True: M's literal fit of data that contain n.l; else RF is multiplied by n.l when shading.
  bool cosineInModel = false;
  std::optional<Crop> crop;                   ///< texels to fit; all by default
  std::size_t memory = std::size_t{4} << 30;  ///< bytes for the samples of one block of rows

  Result<void> validate() const;
};

/// What is the same for every texel of a fit.
struct FitProblem {
  std::vector<glm::vec3> views;
  std::vector<glm::vec3> lights;
  bool cosineInModel = false;
  std::shared_ptr<const ReflectanceModel> model;
};

/// Fits the parameters of one texel to its samples: one class a model. Thread safe.
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
  /// Fails on an unknown model and on measurements that do not determine its parameters.
  Result<std::unique_ptr<TexelFitter>> create(const FitProblem& problem) const;

 private:
  std::vector<std::pair<std::string, Factory>> factories_;
};

struct FitResult {
  ReflectanceField field;
  FitErrors errors;  ///< of the field as stored, over all measured pairs
  double secondsReading = 0.0;
  double secondsFitting = 0.0;
};

/// Fits a whole measurement, texels in parallel, blocks of rows within options.memory. The result does not
/// depend on the number of threads.
Result<FitResult> fitReflectanceField(const BtfSource& source, const FitOptions& options,
                                      const Progress& progress = {});

}  // namespace weft
