#include "weft/reflectance/RfnlModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/core/Direction.h"

namespace weft {

Result<std::shared_ptr<const ReflectanceModel>> RfnlModel::create(const ModelDescription& description) {
  if (description.lobes < 1 || description.lobes > kMaximumLobes)
    return fail(fmt::format("{} cannot have {} lobes", description.name, description.lobes), {},
                fmt::format("1 to {}", kMaximumLobes));
  return std::make_shared<const RfnlModel>(description);
}

LayerDirections RfnlModel::layerDirections() const {
  return description().name == "lfnl" ? LayerDirections::Lights : LayerDirections::Views;
}

std::vector<std::string> RfnlModel::sharedNumbers() const {
  if (ownDiffuseAlbedo()) return {};
  return {"rho_d"};
}

std::vector<std::string> RfnlModel::layerNumbers() const {
  std::vector<std::string> names;
  for (int j = 0; j < description().lobes; ++j)
    for (const char* part : {"amplitude", "px", "py", "exponent"})
      names.push_back(fmt::format("lobe{}.{}", j, part));
  if (ownDiffuseAlbedo()) names.push_back("rho_d");
  return names;
}

float RfnlModel::evaluate(std::span<const float> shared, std::span<const float> layer, glm::vec3 light,
                          glm::vec3 view) const {
  const glm::vec3 varied = variedDirection(light, view);
  float value = ownDiffuseAlbedo() ? layer.back() : shared[0];
  for (std::size_t j = 0; j < static_cast<std::size_t>(description().lobes); ++j) {
    const auto lobe = layer.subspan(4 * j, 4);
    const glm::vec3 direction = directionFromParabolic({lobe[1], lobe[2]});
    const float cosine = glm::dot(direction, varied);
    if (cosine > 0.0f) value += lobe[0] * std::pow(cosine, lobe[3]);
  }
  return std::max(value, 0.0f);
}

std::map<std::string, std::string> RfnlModel::shaderDefines() const {
  return {{"LOBES", std::to_string(description().lobes)},
          {"OWN_DIFFUSE_ALBEDO", ownDiffuseAlbedo() ? "1" : "0"}};
}

}  // namespace weft
