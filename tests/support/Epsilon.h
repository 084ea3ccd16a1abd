#pragma once

#include "weft/fitter/FieldFit.h"

namespace weft::test {

/// eps of luminance, on average over all pairs of view and light.
inline double epsilon(const FitResult& result, ErrorSpace space = ErrorSpace::Linear) {
  return result.errors.of(space, ErrorMeasure::Luminance).average;
}

}  // namespace weft::test
