#pragma once

#include <array>
#include <utility>

#include "weft/core/Result.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"

namespace weft {

/// Some rows of a field's texels in memory, and others around them; the field repeats. Reading from
/// it is for any number of threads.
class SampleWindow {
 public:
  /// Rows first .. first + count - 1 of the field that `crop` cuts out, and `halo` more on both
  /// sides. Rows that are read one after another into the same window share its memory.
  Result<void> read(const BtfSource& source, const Crop& crop, int first, int count, int halo);

  /// The rows that hold a row of the field, which may lie outside of it, and which of them it is.
  std::pair<const SampleRows*, int> find(int row) const;

 private:
  struct Part {
    int first = 0;
    int count = 0;
    SampleRows rows{};
  };

  int height_ = 0;
  std::array<Part, 3> parts_;  ///< those before the field's beginning, within it, beyond its end
};

}  // namespace weft
