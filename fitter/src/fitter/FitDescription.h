#pragma once

#include <string>

#include "weft/core/Result.h"
#include "weft/fitter/FieldFit.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"
#include "weft/reflectance/FieldFormula.h"

namespace weft {

/// What a fit with these options makes of a measurement, without a report; of the directions that
/// are not held out, and of lights above the horizon.
ReflectanceFieldDescription descriptionOf(const BtfDescription& measured, const FitOptions& options,
                                          const ReflectanceModel& model);

/// Everything that decides the numbers of a fit, for people to compare. What the measurement is
/// called does not. Empty where no rows are kept.
Result<std::string> fingerprintOf(const BtfSource& source, const FitOptions& options, const Crop& crop,
                                  const ModelDescription& model);

}  // namespace weft
