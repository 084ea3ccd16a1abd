#include "GltfLights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "weft/scenegraph/Light.h"

namespace weft {
namespace {

constexpr float kAngleTolerance = 1e-3f;  // of files that round their angles

float rangeOf(const tinygltf::Light& light) {
  return light.range > 0.0 ? static_cast<float>(light.range) : std::numeric_limits<float>::infinity();
}

/// Null where the cone is none.
std::shared_ptr<Light> spotFrom(const tinygltf::Light& light, glm::vec3 intensity, const std::string& name,
                                std::vector<std::string>& warnings) {
  constexpr float kWidest = glm::half_pi<float>();
  const auto inner = static_cast<float>(light.spot.innerConeAngle);
  const auto outer = static_cast<float>(light.spot.outerConeAngle);
  const bool valid =
      inner >= 0.0f && outer > 0.0f && inner <= outer + kAngleTolerance && outer <= kWidest + kAngleTolerance;
  if (!valid) return nullptr;
  if (inner >= outer)
    warnings.push_back("the cone of " + name + " is as wide inside as outside: it gets a hard edge");
  auto spot = std::make_shared<SpotLight>(intensity, std::min(inner, outer), std::min(outer, kWidest));
  spot->range = rangeOf(light);
  return spot;
}

}  // namespace

Result<std::shared_ptr<Light>> lightFrom(const GltfFile& file, int index,
                                         std::vector<std::string>& warnings) {
  const std::string name = "light " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= file.model.lights.size())
    return file.fail(name + ", which a node names, does not exist");
  const tinygltf::Light& light = file.model.lights[static_cast<std::size_t>(index)];
  glm::vec3 intensity(static_cast<float>(light.intensity));
  if (light.color.size() == 3) intensity *= glm::vec3(light.color[0], light.color[1], light.color[2]);
  const bool valid = (light.color.empty() || light.color.size() == 3) && intensity.x >= 0.0f &&
                     intensity.y >= 0.0f && intensity.z >= 0.0f && std::isfinite(glm::length(intensity));
  if (!valid) return file.fail(name + " has a broken colour or intensity");
  if (light.type == "directional") return std::make_shared<DirectionalLight>(intensity);
  if (light.type == "point") {
    auto point = std::make_shared<PointLight>(intensity);
    point->range = rangeOf(light);
    return point;
  }
  std::shared_ptr<Light> spot;
  if (light.type == "spot") spot = spotFrom(light, intensity, name, warnings);
  if (!spot) return file.fail(name + " is of no kind that glTF knows, or has a broken cone");
  return spot;
}

}  // namespace weft
