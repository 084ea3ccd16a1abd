#pragma once

#include <span>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// Where the values of texels come from whose distances matter: rows that are loaded, then read by
/// any number of threads.
class TexelValues {
 public:
  virtual ~TexelValues() = default;

  virtual int width() const = 0;
  virtual int height() const = 0;
  /// How many values a texel has; a distance of 1 in each is a distance of 1 of texels.
  virtual int count() const = 0;
  virtual int rowsAtOnce() const { return height(); }
  virtual Result<void> load(int /*firstRow*/, int /*rows*/) { return {}; }
  /// Of a texel in the rows that are loaded.
  virtual void read(int x, int y, std::span<float> out) const = 0;
};

/// Values along their principal axes, those with most variance first, as few as keep 99.5 % of it
/// and at most 96. The axes are those of up to 1,024 texels, spread evenly.
Result<AppearanceSample> principalAppearance(TexelValues& values, const Progress& progress);

}  // namespace weft
