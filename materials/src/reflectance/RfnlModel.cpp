#include "weft/reflectance/RfnlModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "weft/core/Direction.h"
#include "weft/reflectance/CosineLobe.h"

namespace weft {

std::vector<ModelType> RfnlModel::types() {
  const auto typeOf = [](std::string name, std::string purpose, LayerDirections directions) {
    return ModelType{std::move(name),
                     std::move(purpose),
                     {ModelOption::number("lobes", "cosine lobes a layer", 2, 1, kMaximumLobes),
                      ModelOption::choice("rho_d",
                                          "the diffuse albedo: one for all layers, or each its own (smaller "
                                          "errors, larger file)",
                                          {{"shared", ""}, {"per-view", "rho_d per view"}}),
                      ModelOption::color()},
                     [directions](ModelOptions options) {
                       return std::make_shared<const RfnlModel>(std::move(options), directions);
                     }};
  };
  return {typeOf("rfnl", "A diffuse albedo and cosine lobes of the light for every view.",
                 LayerDirections::Views),
          typeOf("lfnl", "A diffuse albedo and cosine lobes of the view for every light.",
                 LayerDirections::Lights)};
}

RfnlModel::RfnlModel(ModelOptions options, LayerDirections layerDirections)
    : ReflectanceModel(std::move(options)),
      layerDirections_(layerDirections),
      lobes_(this->options().number("lobes")),
      ownDiffuseAlbedo_(this->options().word("rho_d") == "per-view") {}

std::vector<std::string> RfnlModel::sharedParameters() const {
  if (ownDiffuseAlbedo_) return {};
  return {"rho_d"};
}

std::vector<std::string> RfnlModel::layerParameters() const {
  std::vector<std::string> names;
  for (int j = 0; j < lobes_; ++j)
    for (const char* part : {"amplitude", "px", "py", "exponent"})
      names.push_back(fmt::format("lobe{}.{}", j, part));
  if (ownDiffuseAlbedo_) names.push_back("rho_d");
  return names;
}

float RfnlModel::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                          glm::vec3 view) const {
  float value = 0.0f;
  evaluateLights(shared, layer, {&light, 1}, view, {&value, 1});
  return value;
}

void RfnlModel::evaluateLights(std::span<const float> shared, std::span<const float> layer,
                               std::span<const glm::vec3> lights, glm::vec3 view,
                               std::span<float> values) const {
  std::ranges::fill(values, diffuseAlbedoOf(shared, layer));
  for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j) {
    const auto lobe = layer.subspan(4 * j, 4);
    const glm::vec3 direction = directionFromParabolic({lobe[1], lobe[2]});
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const float cosine = glm::dot(direction, variedDirection(lights[i], view));
      if (cosine > 0.0f) values[i] += lobe[0] * std::pow(cosine, lobe[3]);
    }
  }
  for (float& value : values) value = std::max(value, 0.0f);
}

// [Meseth 2004] 5.2.
glm::vec3 RfnlModel::underEnvironment(std::span<const float> shared, std::span<const float> layer, glm::vec3,
                                      const EnvironmentIntegrals& light) const {
  glm::vec3 value = diffuseAlbedoOf(shared, layer) * light.diffuse({0, 0, 1});
  for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j) {
    const auto lobe = layer.subspan(4 * j, 4);
    if (lobe[0] != 0.0f) value += lobe[0] * light.lobe(directionFromParabolic({lobe[1], lobe[2]}), lobe[3]);
  }
  return glm::max(value, 0.0f);
}

// Lobes above the horizon, with log2 of their exponents.
bool RfnlModel::prepareForEnvironments(std::span<float> layer) const {
  if (!integratesEnvironments()) return false;
  for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j) {
    const auto lobe = layer.subspan(4 * j, 4);
    const CosineLobe above = lobeAboveHorizon(directionFromParabolic({lobe[1], lobe[2]}), lobe[3], {0, 0, 1});
    const glm::vec2 p = parabolicFromDirection(above.direction);
    lobe[0] *= above.amount;
    lobe[1] = p.x;
    lobe[2] = p.y;
    lobe[3] = std::log2(above.exponent);
  }
  return true;
}

std::map<std::string, std::string> RfnlModel::shaderDefines() const {
  return {{"LOBES", std::to_string(lobes_)}, {"OWN_DIFFUSE_ALBEDO", ownDiffuseAlbedo_ ? "1" : "0"}};
}

}  // namespace weft
