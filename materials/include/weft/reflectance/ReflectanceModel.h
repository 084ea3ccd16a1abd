#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Result.h"
#include "weft/reflectance/EnvironmentIntegrals.h"
#include "weft/reflectance/FieldTables.h"
#include "weft/reflectance/ModelOptions.h"
#include "weft/reflectance/Registration.h"

namespace weft {

/// The directions for which a model has a set of numbers each, a *layer*. Between them values are
/// interpolated.
enum class LayerDirections {
  None,    ///< one set of numbers for everything
  Views,   ///< the measured views: a reflectance field, RF_v(x, l)
  Lights,  ///< the measured lights: a light field, LF_l(x, v) ([Meseth 2004] 3.1)
};

/// The formula of one reflectance model: what its numbers are called and what they evaluate to. The
/// CPU reference for the GLSL file of the same name.
///
/// A texel has *shared* numbers (one set) and *layer* numbers (one set a measured view, or light,
/// or none at all: layerDirections()). Immutable, thread safe.
class ReflectanceModel {
 public:
  explicit ReflectanceModel(ModelOptions options);
  virtual ~ReflectanceModel() = default;

  /// Its name, and a value for every option that its type declares.
  const ModelDescription& description() const { return options_.description(); }
  const ModelOptions& options() const { return options_; }
  virtual LayerDirections layerDirections() const { return LayerDirections::Views; }
  /// Whether evaluate() gives values that contain n.l by its very formula; else that is up to the
  /// fit.
  virtual bool containsCosine() const { return false; }
  /// Names of the shared numbers but the base colour, in the order in which evaluate() and the GLSL
  /// read them.
  virtual std::vector<std::string> sharedParameters() const { return {}; }
  /// Names of one layer's numbers, likewise.
  virtual std::vector<std::string> layerParameters() const { return {}; }
  /// Whether light is linear in the shared numbers, so that they may be filtered between texels and
  /// averaged for coarser levels. They lie in -1..1 then, and a GPU keeps a byte of each.
  virtual bool filtersParameters() const { return false; }
  /// How many levels a texel's value is the sum of, once bound: evaluate() is given a base colour,
  /// then the shared numbers of all of them, the finest first (LevelSum.h). These lie in -1..1, and
  /// a GPU keeps a byte of each. 0: the texels of each level stand for themselves.
  virtual int summedLevels() const { return 0; }
  /// The tables that it evaluates with.
  virtual std::vector<ModelTable> tables() const { return {}; }
  /// This model with its tables, which are all there and of the declared shapes (boundModel()).
  /// Only models that declare tables are asked; others of theirs are never evaluated. Fails on
  /// contents that are none.
  virtual Result<std::shared_ptr<const ReflectanceModel>> bind(
      std::shared_ptr<const FieldTables> tables) const;
  /// The numbers of a layer that all texels share, for models without layerParameters(), once
  /// bound; empty where there is no such layer.
  virtual std::span<const float> commonLayer(int) const { return {}; }
  /// How its texels move with the view, once bound.
  virtual const Registration& registration() const;
  /// What the base colour is multiplied by for unit directions in the tangent frame, clamped at 0
  /// (conventions.md, "Clamp"); with or without n.l, as the fit was made. Spans are as long as the
  /// lists of names.
  virtual float evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                         glm::vec3 view) const = 0;
  /// evaluate() for many lights and one view, into `values`; models override it where a loop is
  /// faster.
  virtual void evaluateLights(std::span<const float> shared, std::span<const float> layer,
                              std::span<const glm::vec3> lights, glm::vec3 view,
                              std::span<float> values) const;
  /// A common layer's numbers for some lights alone, from which evaluateSampled() is quicker.
  virtual std::vector<float> sampledLayer(std::span<const float>, std::span<const glm::vec3>) const {
    return {};
  }
  /// evaluateColors() with what sampledLayer() gave for the lights.
  virtual void evaluateSampled(std::span<const float> shared, std::span<const float> sampled,
                               std::span<const glm::vec3> lights, glm::vec3 view,
                               std::span<glm::vec3> colors) const;
  /// Whether underEnvironment() and the GLSL function of the same name exist. Fields of other
  /// models are summed over their measured lights (LightQuadrature).
  virtual bool integratesEnvironments() const { return false; }
  /// What evaluate(), times n.l unless it contains that, shows of an environment; in the units of
  /// EnvironmentIntegrals.
  virtual glm::vec3 underEnvironment(std::span<const float> shared, std::span<const float> layer,
                                     glm::vec3 view, const EnvironmentIntegrals& light) const;
  /// Turns a layer's numbers into those that the GLSL's underEnvironment() reads where
  /// ENVIRONMENT_LAYERS is defined, because they need not be found at each pixel; false where there
  /// are none.
  virtual bool prepareForEnvironments(std::span<float>) const { return false; }
  /// The GLSL file that computes the same ("rfnl.glsl"), and `#define`s for it.
  virtual std::string shaderFile() const = 0;
  /// The text of that file, for models that are not part of Weft; empty: one of shaders/.
  virtual std::string shaderText() const { return {}; }
  virtual std::map<std::string, std::string> shaderDefines() const { return {}; }

  /// 1, or 3 where the option `color` is "rgb" (ModelOption::color()).
  int colorChannels() const { return colorChannels_; }
  /// The channels of a field's shared image: the base colour, then the shared numbers, of red,
  /// green and blue one after another with three colour channels ("rho_d.R").
  std::vector<std::string> sharedChannels() const;
  /// The channels of a field's layers, likewise.
  std::vector<std::string> layerChannels() const;
  /// evaluate() for every colour channel, times the base colour. Spans are as long as the lists of
  /// channels.
  virtual glm::vec3 evaluateColor(std::span<const float> shared, std::span<const float> layer,
                                  glm::vec3 light, glm::vec3 view) const;
  /// The same for many lights and one view.
  virtual void evaluateColors(std::span<const float> shared, std::span<const float> layer,
                              std::span<const glm::vec3> lights, glm::vec3 view,
                              std::span<glm::vec3> colors) const;
  /// underEnvironment() likewise: each colour channel of a fit in RGB has numbers of its own.
  virtual glm::vec3 colorUnderEnvironment(std::span<const float> shared, std::span<const float> layer,
                                          glm::vec3 view, const EnvironmentIntegrals& light) const;

 protected:
  /// The direction that varies within a layer.
  glm::vec3 variedDirection(glm::vec3 light, glm::vec3 view) const {
    return layerDirections() == LayerDirections::Lights ? view : light;
  }

 private:
  ModelOptions options_;
  int colorChannels_;
};

}  // namespace weft
