#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/HemisphereTriangulation.h"
#include "weft/core/Result.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// Everything about a fit but its numbers.
struct ReflectanceFieldDescription {
  std::vector<glm::vec3> views;   ///< measured view directions, tangent frame, unit
  std::vector<glm::vec3> lights;  ///< measured light directions, likewise
  bool hasCosine = false;         ///< RF contains n.l (M's literal fit) instead of being multiplied by it
  std::string source;             ///< the name of the measurement, for people
  std::string fitReport;          ///< JSON text of the fit's errors, as weft-fit wrote it; may be empty
};

/// The value, n.l included, that a model's parameters give for light from `light`; 0 below the horizon.
///
/// Without the cosine in the model this is RF(l) l.z. With it, lights below the outermost measured ring (z <
/// lowestLightZ) are evaluated on that ring and scaled by l.z / lowestLightZ, so that the fit is never
/// extrapolated and still ends at the terminator.
glm::vec3 evaluateWithCosine(const ReflectanceModel& model, bool hasCosine, float lowestLightZ,
                             std::span<const float> shared, std::span<const float> view, glm::vec3 light);

/// The smallest z of a set of directions.
float lowestZ(std::span<const glm::vec3> directions);

/// A fitted material in memory: the parameters of a ReflectanceModel for every texel and view, and the CPU
/// reference of how they are shaded (paper M eq. 4).
///
/// Values are in units of a white Lambertian surface lit head-on: radiance = value x irradiance / pi, n.l
/// included. Immutable, thread safe.
class ReflectanceField {
 public:
  /// `shared`: one layer, the model's shared channels; `views`: a layer a view, the model's view channels.
  /// Fails when shapes, channel names or directions do not fit together or a parameter is not finite.
  static Result<ReflectanceField> create(std::shared_ptr<const ReflectanceModel> model,
                                         ReflectanceFieldDescription description, FloatImage shared,
                                         FloatImage views);

  int width() const { return shared_.width(); }
  int height() const { return shared_.height(); }
  int viewCount() const { return views_.layers(); }
  const ReflectanceModel& model() const { return *model_; }
  const ReflectanceFieldDescription& description() const { return description_; }
  const FloatImage& shared() const { return shared_; }
  const FloatImage& views() const { return views_; }
  const HemisphereTriangulation& triangulation() const { return triangulation_; }
  /// The z of the outermost measured lights: where a field that has the cosine is evaluated for lights below
  /// them.
  float lowestLightZ() const { return lowestLightZ_; }

  /// The value of one texel seen from a measured view, n.l included; 0 for lights below the horizon.
  glm::vec3 evaluateView(int x, int y, int view, glm::vec3 light) const;
  /// The same interpolated between three views with the given weights.
  glm::vec3 evaluate(int x, int y, const DirectionWeights& view, glm::vec3 light) const;

 private:
  std::shared_ptr<const ReflectanceModel> model_;
  ReflectanceFieldDescription description_;
  FloatImage shared_;
  FloatImage views_;
  HemisphereTriangulation triangulation_;
  float lowestLightZ_ = 0.0f;
};

}  // namespace weft
