#include "weft/reflectance/RfpModel.h"

#include <algorithm>
#include <glm/common.hpp>

#include "weft/core/CpuVersions.h"

namespace weft {
namespace {

[[gnu::always_inline]] inline float polynomial(std::span<const float> a, glm::vec3 d) {
  return std::max(a[0] * d.x * d.x + a[1] * d.y * d.y + a[2] * d.x * d.y + a[3] * d.x + a[4] * d.y + a[5],
                  0.0f);
}

WEFT_CPU_VERSIONS
void polynomials(std::span<const float> a, std::span<const glm::vec3> directions, std::span<float> values) {
#pragma omp simd
  for (std::size_t i = 0; i < directions.size(); ++i) values[i] = polynomial(a, directions[i]);
}

}  // namespace

std::vector<ModelType> RfpModel::types() {
  const auto typeOf = [](std::string name, std::string purpose, LayerDirections directions) {
    return ModelType{
        std::move(name), std::move(purpose), {ModelOption::color()}, [directions](ModelOptions options) {
          return std::make_shared<const RfpModel>(std::move(options), directions);
        }};
  };
  std::vector<ModelType> types{
      typeOf("rfp", "A biquadratic polynomial of the light for every view.", LayerDirections::Views),
      typeOf("lfp", "A biquadratic polynomial of the view for every light.", LayerDirections::Lights),
      typeOf("ptm", "A polynomial texture map: rfp of a single view.", LayerDirections::Views)};
  types.back().fitsStoredValues = true;
  return types;
}

std::vector<std::string> RfpModel::layerParameters() const {
  return {"a0", "a1", "a2", "a3", "a4", "a5"};
}

float RfpModel::evaluate(std::span<const float>, std::span<const float> a, glm::vec3 light,
                         glm::vec3 view) const {
  return polynomial(a, variedDirection(light, view));
}

// Exact, but that it is the integral that is clamped and not the polynomial.
glm::vec3 RfpModel::underEnvironment(std::span<const float>, std::span<const float> a, glm::vec3,
                                     const EnvironmentIntegrals& light) const {
  const std::array<glm::vec3, 6> moments = light.moments();
  glm::vec3 value(0.0f);
  for (std::size_t i = 0; i < 6; ++i) value += a[i] * moments[i];
  return glm::max(value, 0.0f);
}

void RfpModel::evaluateLights(std::span<const float>, std::span<const float> a,
                              std::span<const glm::vec3> lights, glm::vec3 view,
                              std::span<float> values) const {
  if (layerDirections_ == LayerDirections::Views)
    polynomials(a, lights, values);
  else
    std::ranges::fill(values, polynomial(a, view));
}

}  // namespace weft
