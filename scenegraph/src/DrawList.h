#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <vector>

#include "weft/chunks/State.h"
#include "weft/scenegraph/Geometry.h"

namespace weft {

/// One geometry to draw.
struct DrawItem {
  std::uint64_t key = 0;
  const Geometry* geometry = nullptr;
  const State* state = nullptr;
  glm::mat4 model{1.0f};
};

/// What a frame draws, in the order that changes the least state: opaque things by program, then state, then
/// from front to back; then the blended ones from back to front.
class DrawList {
 public:
  /// `depth`: the distance in front of the camera; behind it counts as 0.
  void add(const Geometry& geometry, const State& state, const glm::mat4& model, float depth);
  void sort();

  const std::vector<DrawItem>& items() const { return items_; }

 private:
  std::vector<DrawItem> items_;
  std::map<const void*, std::uint64_t> numbers_;  ///< of programs and states, in the order of their coming
};

}  // namespace weft
