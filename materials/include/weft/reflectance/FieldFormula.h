#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weft/core/Color.h"
#include "weft/core/HemisphereTriangulation.h"
#include "weft/core/Result.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// Everything about a fit but its numbers.
struct ReflectanceFieldDescription {
  std::vector<glm::vec3> views;   ///< fitted view directions, tangent frame, unit
  std::vector<glm::vec3> lights;  ///< fitted light directions, likewise
  /// the model contains n.l ([Meseth 2004]'s literal fit) instead of being multiplied by it
  bool hasCosine = false;
  /// Of what the model evaluates to; anything but linear means a literal fit of stored values, as
  /// the papers'.
  Encoding encoding = Encoding::Linear;
  std::string source;     ///< the name of the measurement, for people
  std::string fitReport;  ///< JSON text of the fit's errors, as weft-fit wrote it; may be empty
};

/// Lights as a model is asked for them: FieldFormula::modelledLights() makes them once for many
/// texels.
struct ModelledLights {
  std::vector<glm::vec3> directions;
  std::vector<float> factors;  ///< of the model's values; 0 below the horizon
  /// A layer each: ReflectanceModel::sampledLayer(); empty where layers are the texels' own.
  std::vector<std::vector<float>> layers{};
};

/// How the numbers of a texel become a value: the model, the cosine and the interpolation between
/// layers. The CPU reference of shaders/btf.frag ([Meseth 2004] eq. 4). Immutable, thread safe.
class FieldFormula {
 public:
  /// Fails where the directions are none or not of unit length, or a model that contains n.l has no
  /// light above the horizon.
  static Result<FieldFormula> create(std::shared_ptr<const ReflectanceModel> model,
                                     const ReflectanceFieldDescription& description);

  const ReflectanceModel& model() const { return *model_; }
  /// How many directions there are that values are interpolated between.
  int layerCount() const { return layerCount_; }
  /// For how many of them each texel has numbers of its own: all, or none.
  int storedLayers() const { return layersAreCommon_ ? 0 : layerCount_; }
  /// The numbers of one layer, of those that a texel has of all its stored layers.
  std::span<const float> layerOf(std::span<const float> storedLayers, int layer) const;
  /// What is seen of a surface at a place, in texels, from a view between these layers: the place
  /// plus this; x along columns, y up.
  glm::vec2 shift(const DirectionWeights& layers, glm::vec3 view) const;
  /// Between the directions of the layers.
  const HemisphereTriangulation& triangulation() const { return triangulation_; }
  /// The z of the outermost measured lights above the horizon: where a model that has the cosine
  /// ends.
  float lowestLightZ() const { return lowestLightZ_; }
  /// The z of the outermost measured views: below them, models are shown the view on their ring.
  float lowestViewZ() const { return lowestViewZ_; }

  /// The linear value, n.l included, that one layer's numbers give; 0 for light below the horizon.
  /// Here and below, spans are as long as the model's lists of channels; where it sums levels,
  /// `shared` has the numbers of all (LevelSum.h).
  ///
  /// Without the cosine in the model this is RF l.z. With it, lights below the outermost measured
  /// ring are evaluated on that ring and scaled by l.z / lowestLightZ(), so that the fit is never
  /// extrapolated and still ends at the terminator. Models see a view below the outermost measured
  /// ring as on it, at its own azimuth.
  glm::vec3 evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                     glm::vec3 view) const;
  /// The same for many lights and one view, from the numbers of a texel's stored layers.
  void evaluateLights(std::span<const float> shared, std::span<const float> storedLayers, int layer,
                      const ModelledLights& lights, glm::vec3 view, std::span<glm::vec3> values) const;
  ModelledLights modelledLights(std::span<const glm::vec3> lights) const;
  /// Whether light of an environment is integrated by the model's own formula; else quadrature() is
  /// summed.
  bool integratesEnvironments() const { return quadrature_.nodes.empty(); }
  const LightQuadrature& quadrature() const { return quadrature_; }
  /// What one layer shows of an environment, by the model's formula.
  glm::vec3 underEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3 view,
                             const EnvironmentIntegrals& light) const;
  /// The layers to interpolate, and their weights.
  DirectionWeights layersAround(glm::vec3 light, glm::vec3 view) const;

 private:
  glm::vec3 modelledLight(glm::vec3 light, float& factor) const;
  void expectNumbers(std::span<const float> shared, std::span<const float> layer) const;

  std::shared_ptr<const ReflectanceModel> model_;
  HemisphereTriangulation triangulation_;
  std::size_t sharedNumbers_ = 0;
  std::size_t layerNumbers_ = 0;
  int layerCount_ = 0;
  bool layersAreCommon_ = false;
  bool hasCosine_ = false;
  Encoding encoding_ = Encoding::Linear;
  float lowestLightZ_ = 0.0f;
  float lowestViewZ_ = 0.0f;
  LightQuadrature quadrature_;  ///< empty where it is not needed
};

}  // namespace weft
