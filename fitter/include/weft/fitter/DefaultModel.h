#pragma once

#include <string>

#include "weft/measurement/BtfSource.h"

namespace weft {

/// A model, and why it is taken.
struct DefaultModel {
  std::string name;
  std::string reason;  ///< for people: "12 lights of one view"
};

/// What a measurement is fitted with where no model is asked for: `loom` where it has several
/// views. One view is fitted with `rfnl`, with fewer than 16 lights `rfp`, with fewer than 8 `ptm`,
/// which have the smallest errors on lights that were not fitted (docs/fitting.md); with `bump`
/// where the lights do not determine those, as on one ring.
DefaultModel defaultModel(const BtfDescription& measured);

}  // namespace weft
