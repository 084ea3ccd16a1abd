#pragma once

#include "weft/synthesis/AppearanceVectors.h"

namespace weft {

/// The texels of a sample that may be sources.
struct SourceRegion {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

inline SourceRegion sourcesOf(const AppearanceSample& sample) {
  const AppearanceVectors& v = sample.vectors;
  return {sample.margin, sample.margin, v.width - 2 * sample.margin, v.height - 2 * sample.margin};
}

}  // namespace weft
