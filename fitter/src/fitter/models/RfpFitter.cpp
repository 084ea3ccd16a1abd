#include "models/RfpFitter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "models/ExchangedFitter.h"
#include "weft/fitter/LinearFitter.h"

namespace weft {

Result<std::unique_ptr<TexelFitter>> makeRfpFitter(const FitProblem& problem) {
  return LinearFitter::create(problem, [](glm::dvec3 l, std::span<double> terms) {
    std::ranges::copy(std::array{l.x * l.x, l.y * l.y, l.x * l.y, l.x, l.y, 1.0}, terms.begin());
  });
}

Result<std::unique_ptr<TexelFitter>> makeLfpFitter(const FitProblem& problem) {
  return ExchangedFitter::create(problem, makeRfpFitter);
}

Result<std::unique_ptr<TexelFitter>> makePtmFitter(const FitProblem& problem) {
  if (problem.views.size() != 1)
    return fail(
        fmt::format("a polynomial texture map is of one view, this measurement has {}", problem.views.size()),
        {}, "fit rfp, which is one for every view");
  return makeRfpFitter(problem);
}

}  // namespace weft
