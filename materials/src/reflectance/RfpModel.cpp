#include "weft/reflectance/RfpModel.h"

#include <algorithm>

namespace weft {

Result<std::shared_ptr<const ReflectanceModel>> RfpModel::create(const ModelDescription& description) {
  return std::make_shared<const RfpModel>(
      ModelDescription{description.name, 0, DiffuseAlbedo::Shared, description.color});
}

LayerDirections RfpModel::layerDirections() const {
  return description().name == "lfp" ? LayerDirections::Lights : LayerDirections::Views;
}

std::vector<std::string> RfpModel::layerNumbers() const {
  return {"a0", "a1", "a2", "a3", "a4", "a5"};
}

float RfpModel::evaluate(std::span<const float>, std::span<const float> a, glm::vec3 light,
                         glm::vec3 view) const {
  const glm::vec3 d = variedDirection(light, view);
  return std::max(a[0] * d.x * d.x + a[1] * d.y * d.y + a[2] * d.x * d.y + a[3] * d.x + a[4] * d.y + a[5],
                  0.0f);
}

}  // namespace weft
