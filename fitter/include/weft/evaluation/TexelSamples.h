#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "weft/measurement/BtfSource.h"

namespace weft {

/// All pairs of one texel, `[view][light]`, n.l included, linear and as the measurement stores
/// them.
struct TexelSamples {
  std::vector<glm::vec3> linear;
  std::vector<glm::vec3> stored;
};

/// Where samples of a texel lie.
struct SamplePlace {
  const SampleRows* rows = nullptr;
  int row = 0;
  int column = 0;
};

/// The samples of a texel, which all views show at one place, or each at its own; numbers that are
/// none become black.
TexelSamples texelSamples(const BtfDescription& measured, std::span<const SamplePlace> places);
inline TexelSamples texelSamples(const BtfDescription& measured, const SamplePlace& place) {
  return texelSamples(measured, {&place, 1});
}

}  // namespace weft
