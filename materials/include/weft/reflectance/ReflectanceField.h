#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/reflectance/FieldFormula.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// A fitted material in memory: the numbers of a ReflectanceModel for every texel and layer, and the CPU
/// reference of how they are shaded (paper M eq. 4).
///
/// Values are in units of a white Lambertian surface lit head-on: radiance = value x irradiance / pi, n.l
/// included. Immutable, thread safe.
class ReflectanceField {
 public:
  /// `shared`: one layer, the model's shared channels; `layers`: a layer a view or light, the model's layer
  /// channels, empty for a model without. Fails when shapes, channel names or directions do not fit together
  /// or a number is not finite.
  static Result<ReflectanceField> create(std::shared_ptr<const ReflectanceModel> model,
                                         ReflectanceFieldDescription description, FloatImage shared,
                                         FloatImage layers);

  int width() const { return shared_.width(); }
  int height() const { return shared_.height(); }
  const ReflectanceModel& model() const { return formula_.model(); }
  const FieldFormula& formula() const { return formula_; }
  const ReflectanceFieldDescription& description() const { return description_; }
  const FloatImage& shared() const { return shared_; }
  const FloatImage& layers() const { return layers_; }

  /// The value of one texel, n.l included, of one layer alone; 0 for lights below the horizon. `layer` does
  /// not matter for a model without layers.
  glm::vec3 evaluateLayer(int x, int y, int layer, glm::vec3 light, glm::vec3 view) const;
  /// The same interpolated between three layers with the given weights.
  glm::vec3 evaluate(int x, int y, const DirectionWeights& layers, glm::vec3 light, glm::vec3 view) const;
  /// The same between the layers around the directions.
  glm::vec3 evaluate(int x, int y, glm::vec3 light, glm::vec3 view) const;
  /// What one texel shows of an environment, radiance: the CPU reference of shaders/btf.frag.
  glm::vec3 underEnvironment(int x, int y, glm::vec3 view, const SurfaceLight& light) const;

 private:
  explicit ReflectanceField(FieldFormula formula) : formula_(std::move(formula)) {}

  FieldFormula formula_;
  ReflectanceFieldDescription description_;
  FloatImage shared_;
  FloatImage layers_;
};

}  // namespace weft
