#include "weft/reflectance/RfpModel.h"

#include <algorithm>

namespace weft {

Result<std::shared_ptr<const ReflectanceModel>> RfpModel::create(const ModelDescription&) {
  return std::make_shared<const RfpModel>();
}

ModelDescription RfpModel::description() const {
  return {"rfp", 0, DiffuseAlbedo::Shared};
}

std::vector<std::string> RfpModel::sharedChannels() const {
  return {"R", "G", "B"};
}

std::vector<std::string> RfpModel::viewChannels() const {
  return {"a0", "a1", "a2", "a3", "a4", "a5"};
}

glm::vec3 RfpModel::evaluate(std::span<const float> shared, std::span<const float> a, glm::vec3 l) const {
  const float polynomial =
      a[0] * l.x * l.x + a[1] * l.y * l.y + a[2] * l.x * l.y + a[3] * l.x + a[4] * l.y + a[5];
  return std::max(polynomial, 0.0f) * glm::vec3(shared[0], shared[1], shared[2]);
}

}  // namespace weft
