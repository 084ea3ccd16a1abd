#pragma once

#include <optional>
#include <string>

#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"

namespace weft {

/// Whether `loom_gloss` is fitted instead of `loom`, and why.
struct GlossChoice {
  bool isTaken = false;
  std::string reason;  ///< for people
};

/// Looks at some hundred texels in the middle, of which about every eighth light and tenth view are
/// held out (HoldOut.h): a lobe is taken if what is interpolated there comes closer with it, the
/// brightest 2 % by a tenth or all by a twentieth. Costs a pass over the measurement, and memory
/// for 64 x 64 texels. Fails where that cannot be read.
Result<GlossChoice> chooseGloss(const BtfSource& source, const std::optional<Crop>& crop);

}  // namespace weft
