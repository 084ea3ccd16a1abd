#pragma once

#include "TestSupport.h"
#include "weft/measurement/BtfSource.h"

namespace weft::test {

/// Every row of a measurement.
inline SampleRows allRows(const BtfSource& source) {
  SampleRows rows;
  requireDone(source.readRows(0, source.description().height, rows));
  return rows;
}

/// Linear RGB of one pair of one texel.
inline glm::vec3 linearSample(const SampleRows& rows, int x, int y, std::size_t pair) {
  glm::vec3 rgb;
  rows.linear(y, x, {&rgb, 1}, pair);
  return rgb;
}

}  // namespace weft::test
