#include "FrameLights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace weft {

namespace {

glm::vec3 unitOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

float inverseSquare(float range) {
  return 1.0f / (range * range);
}

LightBlock blockOf(const PlacedLight& light, const glm::dvec3& eye) {
  const glm::vec4 position(glm::dvec3(light.toWorld[3]) - eye, 0.0f);
  const glm::vec3 backwards = unitOrZero(glm::dvec3(light.toWorld[2]));
  if (const auto* directional = dynamic_cast<const DirectionalLight*>(light.core))
    return {glm::vec4(backwards, 0.0f), glm::vec4(directional->irradiance, 0.0f)};
  if (const auto* point = dynamic_cast<const PointLight*>(light.core))
    return {position, glm::vec4(point->intensity, inverseSquare(point->range))};
  const auto& spot = static_cast<const SpotLight&>(*light.core);
  const float outer = std::cos(spot.outerAngle);
  const float slope = 1.0f / std::max(std::cos(spot.innerAngle) - outer, 1e-3f);
  return {position, glm::vec4(spot.intensity, inverseSquare(spot.range)),
          glm::vec4(-slope * backwards, -slope * outer)};
}

bool isDirectional(const PlacedLight& light) {
  return dynamic_cast<const DirectionalLight*>(light.core) != nullptr;
}

}  // namespace

Result<FrameLights> FrameLights::of(const FlatScene& scene, const View& view) {
  FrameLights lights;
  for (const PlacedLight& light : scene.lights().all()) {
    if (!light.core || !scene.shows(light.level, view.place)) continue;
    if (const auto* environment = dynamic_cast<const EnvironmentLight*>(light.core)) {
      if (lights.environment) return fail("the scene has more than one environment");
      lights.environment = environment;
      lights.environmentToWorld = light.toWorld;
    } else {
      lights.placed.push_back(light);
    }
  }
  if (lights.placed.size() > kMaximumLights)
    return fail(fmt::format("the scene has {} lights, at most {} can be drawn", lights.placed.size(),
                            kMaximumLights));
  const auto others = std::stable_partition(lights.placed.begin(), lights.placed.end(), isDirectional);
  lights.directional = static_cast<std::size_t>(others - lights.placed.begin());
  return lights;
}

void FrameLights::fill(FrameBlock& block, const View& view) const {
  std::transform(placed.begin(), placed.end(), block.lights.begin(),
                 [&](const PlacedLight& light) { return blockOf(light, view.place); });
  if (!environment) return;
  // The columns of a rotation are the rows of its inverse; scale does not move what is infinitely
  // far away.
  for (int i = 0; i < 3; ++i)
    block.environmentRows[static_cast<std::size_t>(i)] =
        glm::vec4(unitOrZero(glm::dvec3(environmentToWorld[i])), 0.0f);
  block.environmentIntensity = glm::vec4(environment->intensity, environment->scale());
}

ShaderVariant FrameLights::variant() const {
  ShaderVariant variant = environment ? environment->variant() : ShaderVariant();
  variant.defines.emplace_back("DIRECTIONAL_LIGHTS", fmt::to_string(directional));
  variant.defines.emplace_back("PLACED_LIGHTS", fmt::to_string(placed.size() - directional));
  return variant;
}

}  // namespace weft
