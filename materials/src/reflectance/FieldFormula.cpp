#include "weft/reflectance/FieldFormula.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/core/BatchEncoding.h"
#include "weft/core/Contract.h"

namespace weft {
namespace {

Result<void> checkDirections(const std::vector<glm::vec3>& directions, const std::string& what) {
  if (directions.empty()) return fail("no " + what + " directions are described");
  for (glm::vec3 direction : directions)
    if (!(std::abs(glm::length(direction) - 1.0f) < 1e-3f))
      return fail("a " + what + " direction is not of unit length");
  return {};
}

// Of the directions above the horizon; 0 where there are none.
float lowestZ(const std::vector<glm::vec3>& directions) {
  float lowest = 0.0f;
  for (glm::vec3 direction : directions)
    if (direction.z > 0.0f && (lowest == 0.0f || direction.z < lowest)) lowest = direction.z;
  return std::min(lowest, 1.0f);  // of unit length but for rounding
}

// The direction, or the one at its azimuth on the ring at height z where it lies below that.
glm::vec3 notBelow(glm::vec3 direction, float z) {
  if (direction.z >= z) return direction;
  const glm::vec2 across(direction);  // 0 where rounding lets the pole lie below a ring at the pole
  const glm::vec2 azimuth = across / std::sqrt(std::max(glm::dot(across, across), 1e-30f));
  return {azimuth * std::sqrt(1.0f - z * z), z};
}

// What evaluate() of a model is given of a texel.
std::size_t numbersOfTexel(const ReflectanceModel& model) {
  const std::size_t numbers = model.sharedChannels().size();
  const auto levels = static_cast<std::size_t>(std::max(model.summedLevels(), 1));
  return numbers + (levels - 1) * (numbers - 3);
}

// Tables have none before they are bound.
Result<void> checkCommonLayers(const ReflectanceModel& model, int count) {
  if (count == 0 || model.commonLayer(0).empty()) return {};
  if (model.commonLayer(count - 1).empty() || !model.commonLayer(count).empty())
    return fail(fmt::format("{} views are described, the tables are of more or fewer", count));
  return {};
}

}  // namespace

Result<FieldFormula> FieldFormula::create(std::shared_ptr<const ReflectanceModel> model,
                                          const ReflectanceFieldDescription& description) {
  WEFT_TRY_VOID(checkDirections(description.views, "view"));
  WEFT_TRY_VOID(checkDirections(description.lights, "light"));
  FieldFormula formula;
  formula.lowestLightZ_ = lowestZ(description.lights);
  // Models of a surface hold from everywhere, tables and lobes only where there were views.
  if (!model->containsCosine()) formula.lowestViewZ_ = lowestZ(description.views);
  if (description.hasCosine && formula.lowestLightZ_ <= 0.0f)
    return fail("a field that contains n.l has no light above the horizon");
  if (model->containsCosine() && !description.hasCosine)
    return fail("the values of the model '" + model->description().name +
                "' contain n.l, the field's do not");
  const LayerDirections kind = model->layerDirections();
  if (kind != LayerDirections::None) {
    const auto& directions = kind == LayerDirections::Views ? description.views : description.lights;
    WEFT_TRY(formula.triangulation_, HemisphereTriangulation::create(directions));
    formula.layerCount_ = static_cast<int>(directions.size());
  }
  const Registration& registration = model->registration();
  if (!registration.empty() && std::ssize(registration.deviations) != formula.layerCount_)
    return fail(fmt::format("{} views are registered and {} are described", registration.deviations.size(),
                            formula.layerCount_));
  formula.layersAreCommon_ = model->layerParameters().empty();
  WEFT_TRY_VOID(checkCommonLayers(*model, formula.layerCount_));
  if (!model->integratesEnvironments() || description.encoding != Encoding::Linear ||
      description.hasCosine != model->containsCosine())
    formula.quadrature_ = LightQuadrature::create(description.lights);
  formula.sharedNumbers_ = numbersOfTexel(*model);
  formula.layerNumbers_ = formula.layersAreCommon_ && formula.layerCount_ > 0 ? model->commonLayer(0).size()
                                                                              : model->layerChannels().size();
  formula.model_ = std::move(model);
  formula.hasCosine_ = description.hasCosine;
  formula.encoding_ = description.encoding;
  return formula;
}

// Where the model is evaluated for a light above the horizon, and what its value is multiplied by.
glm::vec3 FieldFormula::modelledLight(glm::vec3 light, float& factor) const {
  factor = hasCosine_ ? 1.0f : light.z;
  if (!hasCosine_ || light.z >= lowestLightZ_) return light;
  factor = light.z / lowestLightZ_;
  return notBelow(light, lowestLightZ_);
}

void FieldFormula::expectNumbers(std::span<const float> shared, std::span<const float> layer) const {
  WEFT_EXPECT(shared.size() == sharedNumbers_ && layer.size() == layerNumbers_,
              "a texel has as many numbers as its model");
}

glm::vec3 FieldFormula::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                                 glm::vec3 view) const {
  expectNumbers(shared, layer);
  if (light.z <= 0.0f) return glm::vec3(0.0f);
  float factor = 0.0f;
  const glm::vec3 modelled = modelledLight(light, factor);
  const glm::vec3 value = model_->evaluateColor(shared, layer, modelled, notBelow(view, lowestViewZ_));
  return factor * (encoding_ == Encoding::Linear ? value : decode(encoding_, value));
}

std::span<const float> FieldFormula::layerOf(std::span<const float> storedLayers, int layer) const {
  if (layersAreCommon_) return model_->commonLayer(layer);
  return storedLayers.subspan(static_cast<std::size_t>(layer) * layerNumbers_, layerNumbers_);
}

glm::vec2 FieldFormula::shift(const DirectionWeights& layers, glm::vec3 view) const {
  const Registration& registration = model_->registration();
  if (registration.empty()) return glm::vec2(0.0f);
  glm::vec2 shift = registration.height * reliefTangent(notBelow(view, lowestViewZ_));
  for (int k = 0; k < 3; ++k)
    shift += layers.weight[k] *
             registration.deviations[static_cast<std::size_t>(layers.index[static_cast<std::size_t>(k)])];
  return shift;
}

void FieldFormula::evaluateLights(std::span<const float> shared, std::span<const float> storedLayers,
                                  int layer, const ModelledLights& lights, glm::vec3 view,
                                  std::span<glm::vec3> values) const {
  WEFT_EXPECT(values.size() == lights.directions.size(), "there is room for a value a light");
  if (!lights.layers.empty()) {
    model_->evaluateSampled(shared, lights.layers[static_cast<std::size_t>(layer)], lights.directions,
                            notBelow(view, lowestViewZ_), values);
  } else {
    const std::span<const float> numbers = layerOf(storedLayers, layer);
    expectNumbers(shared, numbers);
    model_->evaluateColors(shared, numbers, lights.directions, notBelow(view, lowestViewZ_), values);
  }
  if (encoding_ != Encoding::Linear) decodeAll(encoding_, floatsOf(values));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] *= lights.factors[i];
}

ModelledLights FieldFormula::modelledLights(std::span<const glm::vec3> lights) const {
  ModelledLights modelled{std::vector<glm::vec3>(lights.size()), std::vector<float>(lights.size())};
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].z > 0.0f) modelled.directions[i] = modelledLight(lights[i], modelled.factors[i]);
  if (layersAreCommon_ && layerNumbers_ > 0)
    for (int layer = 0; layer < layerCount_; ++layer)
      modelled.layers.push_back(model_->sampledLayer(model_->commonLayer(layer), modelled.directions));
  return modelled;
}

glm::vec3 FieldFormula::underEnvironment(std::span<const float> shared, std::span<const float> layer,
                                         glm::vec3 view, const EnvironmentIntegrals& light) const {
  expectNumbers(shared, layer);
  return model_->colorUnderEnvironment(shared, layer, notBelow(view, lowestViewZ_), light);
}

DirectionWeights FieldFormula::layersAround(glm::vec3 light, glm::vec3 view) const {
  if (layerCount_ == 0) return {};
  return triangulation_.locate(model_->layerDirections() == LayerDirections::Views ? view : light);
}

}  // namespace weft
