#include "weft/reflectance/RfnlModel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "weft/core/Direction.h"

namespace weft {

Result<std::shared_ptr<const ReflectanceModel>> RfnlModel::create(const ModelDescription& description) {
  if (description.lobes < 1 || description.lobes > kMaximumLobes)
    return fail(fmt::format("rfnl cannot have {} lobes", description.lobes), {},
                fmt::format("1 to {}", kMaximumLobes));
  return std::make_shared<const RfnlModel>(description);
}

std::vector<std::string> RfnlModel::sharedChannels() const {
  // The order of one RGBA texel; without a shared albedo the fourth number is not there.
  if (ownDiffuseAlbedo()) return {"R", "G", "B"};
  return {"R", "G", "B", "rho_d"};
}

std::vector<std::string> RfnlModel::viewChannels() const {
  std::vector<std::string> names;
  for (int j = 0; j < description_.lobes; ++j)
    for (const char* part : {"amplitude", "px", "py", "exponent"})
      names.push_back(fmt::format("lobe{}.{}", j, part));
  if (ownDiffuseAlbedo()) names.push_back("rho_d");
  return names;
}

glm::vec3 RfnlModel::evaluate(std::span<const float> shared, std::span<const float> view,
                              glm::vec3 light) const {
  float value = ownDiffuseAlbedo() ? view.back() : shared[3];
  for (std::size_t j = 0; j < static_cast<std::size_t>(description_.lobes); ++j) {
    const auto lobe = view.subspan(4 * j, 4);
    const glm::vec3 direction = directionFromParabolic({lobe[1], lobe[2]});
    const float cosine = glm::dot(direction, light);
    if (cosine > 0.0f) value += lobe[0] * std::pow(cosine, lobe[3]);
  }
  return std::max(value, 0.0f) * glm::vec3(shared[0], shared[1], shared[2]);
}

std::map<std::string, std::string> RfnlModel::shaderDefines() const {
  return {{"LOBES", std::to_string(description_.lobes)},
          {"OWN_DIFFUSE_ALBEDO", ownDiffuseAlbedo() ? "1" : "0"}};
}

}  // namespace weft
