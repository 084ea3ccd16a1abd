#include "weft/fitter/DefaultModel.h"

#include <fmt/format.h>

#include <algorithm>

#include "weft/fitter/FitterRegistry.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {
namespace {

std::vector<std::string> modelsFor(std::size_t lights) {
  if (lights >= 16) return {"rfnl"};
  return {lights >= 8 ? "rfp" : "ptm", "bump"};
}

bool canBeFitted(const std::string& name, const std::vector<glm::vec3>& views,
                 const std::vector<glm::vec3>& lights) {
  const auto model = ModelRegistry::builtin().create({name, {}});
  return model && FitterRegistry::builtin()
                      .create({.views = views,
                               .lights = lights,
                               .cosineInModel = (*model)->containsCosine(),
                               .weighted = true,
                               .model = *model})
                      .has_value();
}

}  // namespace

DefaultModel defaultModel(const BtfDescription& measured) {
  if (measured.views.size() != 1) return {"loom", fmt::format("{} views", measured.views.size())};
  std::vector<glm::vec3> lights = measured.lights;
  std::erase_if(lights, [](glm::vec3 light) { return light.z <= 0.0f; });
  const std::string reason = fmt::format("{} lights of one view", lights.size());
  const std::vector<std::string> models = modelsFor(lights.size());
  for (const std::string& model : models)
    if (canBeFitted(model, measured.views, lights))
      return {model,
              model == models.front() ? reason : reason + ", which do not determine " + models.front()};
  return {models.front(), reason};
}

}  // namespace weft
