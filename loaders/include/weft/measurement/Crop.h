#pragma once

#include <optional>

#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"

namespace weft {

/// A rectangle of texels; row 0 is the top.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

/// The texels to work on: all without a wish. Fails on a rectangle that is not inside the
/// measurement.
Result<Crop> checkedCrop(const std::optional<Crop>& wanted, const BtfDescription& source);

}  // namespace weft
