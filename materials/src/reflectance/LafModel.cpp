#include "weft/reflectance/LafModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace weft {

std::vector<ModelType> LafModel::types() {
  const auto typeOf = [](std::string name, std::string purpose, bool hasViewFactor) {
    return ModelType{
        std::move(name),
        std::move(purpose),
        {ModelOption::number("lobes", "cosine lobes a texel", 2, 1, kMaximumLobes), ModelOption::color()},
        [hasViewFactor](ModelOptions options) {
          return std::make_shared<const LafModel>(std::move(options), hasViewFactor);
        }};
  };
  return {typeOf("laf", "A diffuse albedo and Lafortune's lobes of light and view, for all views at once.",
                 false),
          typeOf("slaf", "laf times a factor for every view.", true)};
}

LafModel::LafModel(ModelOptions options, bool hasViewFactor)
    : ReflectanceModel(std::move(options)),
      lobes_(this->options().number("lobes")),
      hasViewFactor_(hasViewFactor) {}

LayerDirections LafModel::layerDirections() const {
  return hasViewFactor_ ? LayerDirections::Views : LayerDirections::None;
}

std::vector<std::string> LafModel::sharedParameters() const {
  std::vector<std::string> names{"rho_d"};
  for (int j = 0; j < lobes_; ++j)
    for (const char* part : {"amplitude", "p", "q", "exponent"})
      names.push_back(fmt::format("lobe{}.{}", j, part));
  return names;
}

std::vector<std::string> LafModel::layerParameters() const {
  if (hasViewFactor_) return {"view_factor"};
  return {};
}

float LafModel::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                         glm::vec3 view) const {
  float value = shared[0];
  for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j) {
    const auto lobe = shared.subspan(1 + 4 * j, 4);
    const float base = glm::dot(lafAxes({lobe[1], lobe[2]}), light * view);
    if (base > 0.0f) value += lobe[0] * std::pow(base, lobe[3]);
  }
  if (hasViewFactor_) value *= layer[0];
  return std::max(value, 0.0f);
}

// (C . (l v))^n = |t|^n (t . l / |t|)^n with t = C v: lobes of the light as those of `rfnl`.
glm::vec3 LafModel::underEnvironment(std::span<const float> shared, std::span<const float> layer,
                                     glm::vec3 view, const EnvironmentIntegrals& light) const {
  glm::vec3 value = shared[0] * light.diffuse({0, 0, 1});
  for (std::size_t j = 0; j < static_cast<std::size_t>(lobes_); ++j) {
    const auto lobe = shared.subspan(1 + 4 * j, 4);
    const glm::vec3 t = lafAxes({lobe[1], lobe[2]}) * view;
    const float size = glm::length(t);
    if (size > 0.0f) value += lobe[0] * std::pow(size, lobe[3]) * light.lobe(t / size, lobe[3]);
  }
  if (hasViewFactor_) value *= layer[0];
  return glm::max(value, 0.0f);
}

std::map<std::string, std::string> LafModel::shaderDefines() const {
  return {{"LOBES", std::to_string(lobes_)}, {"VIEW_FACTOR", hasViewFactor_ ? "1" : "0"}};
}

glm::vec3 lafAxes(glm::vec2 packed) {
  const float s = std::max({1.0f, std::abs(packed.x), std::abs(packed.y)});
  return {packed.x / s, packed.y / s, 2.0f - s};
}

glm::vec2 packedLafAxes(glm::vec3 axes) {
  return glm::vec2(axes) * (2.0f - axes.z);
}

}  // namespace weft
