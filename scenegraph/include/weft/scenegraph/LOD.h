#pragma once

#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "weft/core/Contract.h"
#include "weft/scenegraph/NodeCore.h"

namespace weft {

/// Shows one of its node's children by the distance to the eye, in world units: child 0 up to
/// ranges[0], child i from ranges[i - 1] to ranges[i], the child after the last range from there
/// on; nothing where that child does not exist. Picking measures from the start of the ray.
class LOD : public NodeCore {
 public:
  /// `ranges` rise; `center`, in the node's coordinates, is where the distance is measured to.
  explicit LOD(std::vector<float> ranges, glm::vec3 center = glm::vec3(0.0f))
      : ranges_(std::move(ranges)), center_(center) {
    for (std::size_t i = 1; i < ranges_.size(); ++i)
      WEFT_EXPECT(ranges_[i - 1] <= ranges_[i], "the ranges of levels of detail rise");
  }

  const std::vector<float>& ranges() const { return ranges_; }
  glm::vec3 center() const { return center_; }

 private:
  std::vector<float> ranges_;
  glm::vec3 center_;
};

}  // namespace weft
