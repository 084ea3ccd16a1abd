#include "weft/evaluation/FittedPairs.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace weft {
namespace {

// Directions of a file have gone through text, so they may differ in the last bit.
std::vector<bool> amongOthers(const std::vector<glm::vec3>& directions,
                              const std::vector<glm::vec3>& others) {
  std::vector<bool> result;
  for (glm::vec3 direction : directions)
    result.push_back(std::ranges::any_of(
        others, [&](glm::vec3 other) { return glm::distance(direction, other) < 1e-4f; }));
  return result;
}

bool allOf(const std::vector<bool>& flags) {
  return std::ranges::find(flags, false) == flags.end();
}

}  // namespace

FittedPairs::FittedPairs(const ReflectanceFieldDescription& description, const BtfDescription& measured)
    : views_(amongOthers(measured.views, description.views)),
      lights_(amongOthers(measured.lights, description.lights)),
      areAll_(true),
      holdOut_(!allOf(views_)) {
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const bool isLit = measured.lights[i].z > 0.0f;
    holdOut_ = holdOut_ || (isLit && !lights_[i]);
    lights_[i] = lights_[i] && isLit;
  }
  areAll_ = allOf(views_) && allOf(lights_);
}

std::vector<glm::vec3> FittedPairs::of(const std::vector<glm::vec3>& all) const {
  std::vector<glm::vec3> fitted;
  for (std::size_t view = 0; view < views_.size(); ++view)
    for (std::size_t light = 0; views_[view] && light < lights_.size(); ++light)
      if (lights_[light]) fitted.push_back(all[view * lights_.size() + light]);
  return fitted;
}

}  // namespace weft
