#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/reflectance/CoordinateMap.h"
#include "weft/reflectance/FieldFormula.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// The numbers of every texel at one resolution.
struct FieldLevel {
  FloatImage shared;  ///< one layer, the model's shared channels
  /// a layer a view or light, the model's layer channels; empty for a model without
  FloatImage layers;
};

/// A fitted material in memory: the numbers of a ReflectanceModel for every texel and layer, and
/// the CPU reference of how they are shaded ([Meseth 2004] eq. 4).
///
/// The same at one resolution or more, *levels*, of which each has half the sides of the one
/// before, and *tables*, which a model may share between all texels.
///
/// Values are in units of a white Lambertian surface lit head-on: radiance = value x irradiance /
/// pi, n.l included. Immutable, thread safe.
class ReflectanceField {
 public:
  /// Level 0 is the finest, the sides of level i are its sides halved i times, rounded down, at
  /// least 1. Binds the model to the tables. Fails when there is no level, when sizes, channel
  /// names, directions or tables do not fit together, or where a number is not finite.
  static Result<ReflectanceField> create(std::shared_ptr<const ReflectanceModel> model,
                                         ReflectanceFieldDescription description,
                                         std::vector<FieldLevel> levels, FieldTables tables = {});
  /// A field of one level without tables.
  static Result<ReflectanceField> create(std::shared_ptr<const ReflectanceModel> model,
                                         ReflectanceFieldDescription description, FloatImage shared,
                                         FloatImage layers);

  /// Of level 0.
  int width() const { return shared().width(); }
  int height() const { return shared().height(); }
  const FloatImage& shared() const { return levels_.front().shared; }
  const FloatImage& layers() const { return levels_.front().layers; }

  /// Bound to its tables.
  const ReflectanceModel& model() const { return formula_.model(); }
  const FieldFormula& formula() const { return formula_; }
  const ReflectanceFieldDescription& description() const { return description_; }
  const std::vector<FieldLevel>& levels() const { return levels_; }
  const FieldTables& tables() const { return *tables_; }

  /// What is seen at one texel of level 0, n.l included, by one layer alone; 0 for lights below the
  /// horizon. `layer` does not matter for a model without layers. Of a registered model that is
  /// another texel of the surface, and where the view lies between measured ones one between
  /// texels.
  glm::vec3 evaluateLayer(int x, int y, int layer, glm::vec3 light, glm::vec3 view) const;
  /// The same interpolated between three layers with the given weights.
  glm::vec3 evaluate(int x, int y, const DirectionWeights& layers, glm::vec3 light, glm::vec3 view) const;
  /// The same between the layers around the directions.
  glm::vec3 evaluate(int x, int y, glm::vec3 light, glm::vec3 view) const;
  /// The same of a texel of the surface that a map makes of this field, whose sample's size is the
  /// field's: the surface is moved by relief first, then looked up in the map.
  glm::vec3 evaluate(const CoordinateMap& map, int x, int y, const DirectionWeights& layers, glm::vec3 light,
                     glm::vec3 view) const;
  /// What one texel shows of an environment, radiance: the CPU reference of shaders/btf.frag.
  glm::vec3 underEnvironment(int x, int y, glm::vec3 view, const EnvironmentIntegrals& light) const;
  /// The shared numbers of what is seen at a texel of level 0 from a view.
  std::span<const float> sharedSeenAt(int x, int y, glm::vec3 view, std::vector<float>& filtered) const {
    return sharedFor(x, y, formula_.layersAround(view, view), view, filtered);
  }

 private:
  explicit ReflectanceField(FieldFormula formula) : formula_(std::move(formula)) {}
  std::span<const float> sharedFor(int x, int y, const DirectionWeights& layers, glm::vec3 view,
                                   std::vector<float>& filtered) const;
  glm::vec3 weighted(std::span<const float> shared, int x, int y, const DirectionWeights& layers,
                     glm::vec3 light, glm::vec3 view) const;
  std::span<const float> layerAt(int x, int y, int layer) const;

  FieldFormula formula_;
  ReflectanceFieldDescription description_;
  std::vector<FieldLevel> levels_;
  std::shared_ptr<const FieldTables> tables_;
};

/// The shared numbers at a place in texels, where the centre of the first is at 0, 0: filtered
/// between the four around it; the image repeats. `filtered` is where they are left unless the
/// place is a texel's.
std::span<const float> filteredTexel(const FloatImage& shared, glm::vec2 place, std::vector<float>& filtered);

/// The same of the surface that a map makes of the image.
std::span<const float> filteredTexel(const FloatImage& shared, const CoordinateMap& map, glm::vec2 place,
                                     std::vector<float>& filtered);

/// The side of level `level` where that of level 0 is `side`.
int sideOfLevel(int side, int level);

}  // namespace weft
