#include <fmt/format.h>

#include "models/BumpFitter.h"
#include "models/LafFitter.h"
#include "models/RfnlFitter.h"
#include "models/RfpFitter.h"
#include "weft/fitter/TexelFitter.h"

namespace weft {

FitterRegistry FitterRegistry::builtin() {
  FitterRegistry registry;
  registry.add("rfp", makeRfpFitter);
  registry.add("rfnl", RfnlFitter::create);
  registry.add("lfp", makeLfpFitter);
  registry.add("lfnl", RfnlFitter::createForLights);
  registry.add("ptm", makePtmFitter);
  registry.add("laf", LafFitter::create);
  registry.add("slaf", LafFitter::create);
  registry.add("bump", BumpFitter::create);
  return registry;
}

void FitterRegistry::add(std::string model, Factory factory) {
  factories_.emplace_back(std::move(model), factory);
}

Result<std::unique_ptr<TexelFitter>> FitterRegistry::create(const FitProblem& problem) const {
  const std::string name = problem.model->description().name;
  for (const auto& [model, factory] : factories_)
    if (model == name) return factory(problem);
  return fail(fmt::format("there is no fitter for the model '{}'", name));
}

}  // namespace weft
