#include "weft/fitter/FitterRegistry.h"

#include <fmt/format.h>

#include "TexelFieldFitter.h"
#include "models/BumpFitter.h"
#include "models/LafFitter.h"
#include "models/LodFitter.h"
#include "models/LoomFitter.h"
#include "models/RfnlFitter.h"
#include "models/RfpFitter.h"

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
  registry.add("loom", LoomFitter::create);
  registry.add("loom_gloss", LoomFitter::create);
  registry.add("lod", LodFitter::create);
  return registry;
}

void FitterRegistry::add(std::string model, Factory factory) {
  factories_.emplace_back(std::move(model), factory);
}

void FitterRegistry::add(std::string model, TexelFactory factory) {
  factories_.emplace_back(std::move(model),
                          [factory](const FitProblem& problem) -> Result<std::unique_ptr<FieldFitter>> {
                            WEFT_TRY(std::unique_ptr<TexelFitter> fitter, factory(problem));
                            return std::make_unique<TexelFieldFitter>(problem, std::move(fitter));
                          });
}

std::vector<std::string> FitterRegistry::names() const {
  std::vector<std::string> names;
  for (const auto& [name, factory] : factories_) names.push_back(name);
  return names;
}

Result<std::unique_ptr<FieldFitter>> FitterRegistry::create(const FitProblem& problem) const {
  const std::string name = problem.model->description().name;
  for (const auto& [model, factory] : factories_)
    if (model == name) return factory(problem);
  return fail(fmt::format("there is no fitter for the model '{}'", name));
}

}  // namespace weft
