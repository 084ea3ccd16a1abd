#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "weft/measurement/BtfSource.h"

namespace weft {

/// All pairs of one texel, `[view][light]`, n.l included, linear and as the measurement stores
/// them.
struct TexelSamples {
  std::vector<glm::vec3> linear;
  std::vector<glm::vec3> stored;
};

/// The samples in a row and column; numbers that are none become black.
TexelSamples texelSamples(const SampleRows& rows, const BtfDescription& measured, int row, int column);

}  // namespace weft
