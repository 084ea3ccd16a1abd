#include "weft/reflectance/FieldFormula.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>


namespace weft {
namespace {

Result<void> checkDirections(const std::vector<glm::vec3>& directions, const std::string& what) {
  if (directions.empty()) return fail("no " + what + " directions are described");
  for (glm::vec3 direction : directions)
    if (!(std::abs(glm::length(direction) - 1.0f) < 1e-3f))
      return fail("a " + what + " direction is not of unit length");
  return {};
}

// Of the lights above the horizon; 0 where there are none.
float lowestZ(const std::vector<glm::vec3>& lights) {
  float lowest = 0.0f;
  for (glm::vec3 light : lights)
    if (light.z > 0.0f && (lowest == 0.0f || light.z < lowest)) lowest = light.z;
  return std::min(lowest, 1.0f);  // of unit length but for rounding
}

}  // namespace

Result<FieldFormula> FieldFormula::create(std::shared_ptr<const ReflectanceModel> model,
                                          const ReflectanceFieldDescription& description) {
  WEFT_TRY_VOID(checkDirections(description.views, "view"));
  WEFT_TRY_VOID(checkDirections(description.lights, "light"));
  FieldFormula formula;
  formula.lowestLightZ_ = lowestZ(description.lights);
  if (description.hasCosine && formula.lowestLightZ_ <= 0.0f)
    return fail("a field that contains n.l has no light above the horizon");
  const LayerDirections kind = model->layerDirections();
  if (kind != LayerDirections::None) {
    const auto& directions = kind == LayerDirections::Views ? description.views : description.lights;
    WEFT_TRY(formula.triangulation_, HemisphereTriangulation::create(directions));
    formula.layerCount_ = static_cast<int>(directions.size());
  }
  formula.model_ = std::move(model);
  formula.hasCosine_ = description.hasCosine;
  formula.encoding_ = description.encoding;
  return formula;
}

glm::vec3 FieldFormula::modelValue(std::span<const float> shared, std::span<const float> layer,
                                   glm::vec3 light, glm::vec3 view) const {
  const glm::vec3 value = model_->evaluateColor(shared, layer, light, view);
  return encoding_ == Encoding::Linear ? value : decode(encoding_, value);
}

glm::vec3 FieldFormula::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                                 glm::vec3 view) const {
  if (light.z <= 0.0f) return glm::vec3(0.0f);
  if (!hasCosine_) return light.z * modelValue(shared, layer, light, view);
  if (light.z >= lowestLightZ_) return modelValue(shared, layer, light, view);
  const glm::vec2 across(light);  // 0 where rounding lets the pole lie below a ring at the pole
  const glm::vec2 azimuth = across / std::sqrt(std::max(glm::dot(across, across), 1e-30f));
  const glm::vec3 onRing(azimuth * std::sqrt(1.0f - lowestLightZ_ * lowestLightZ_), lowestLightZ_);
  return light.z / lowestLightZ_ * modelValue(shared, layer, onRing, view);
}

DirectionWeights FieldFormula::layersAround(glm::vec3 light, glm::vec3 view) const {
  if (layerCount_ == 0) return {};
  return triangulation_.locate(model_->layerDirections() == LayerDirections::Views ? view : light);
}

}  // namespace weft
