#pragma once

#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Makes the fitter of `rfp`. Fails where the lights do not determine the six coefficients: fewer
/// than six, or on one conic.
Result<std::unique_ptr<TexelFitter>> makeRfpFitter(const FitProblem& problem);
/// The same for `lfp`, of which light and view are exchanged.
Result<std::unique_ptr<TexelFitter>> makeLfpFitter(const FitProblem& problem);
/// The same for `ptm`, which is refused for more views.
Result<std::unique_ptr<TexelFitter>> makePtmFitter(const FitProblem& problem);

}  // namespace weft
