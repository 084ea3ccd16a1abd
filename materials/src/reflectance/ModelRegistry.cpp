#include <fmt/format.h>
#include <fmt/ranges.h>

#include "weft/reflectance/BumpModel.h"
#include "weft/reflectance/LafModel.h"
#include "weft/reflectance/ReflectanceModel.h"
#include "weft/reflectance/RfnlModel.h"
#include "weft/reflectance/RfpModel.h"

namespace weft {

ModelRegistry ModelRegistry::builtin() {
  ModelRegistry registry;
  registry.add("rfp", RfpModel::create);
  registry.add("rfnl", RfnlModel::create);
  registry.add("lfp", RfpModel::create);
  registry.add("lfnl", RfnlModel::create);
  registry.add("ptm", RfpModel::create);
  registry.add("laf", LafModel::create);
  registry.add("slaf", LafModel::create);
  registry.add("bump", BumpModel::create);
  return registry;
}

void ModelRegistry::add(std::string name, Factory factory) {
  factories_.emplace_back(std::move(name), factory);
}

std::vector<std::string> ModelRegistry::names() const {
  std::vector<std::string> result;
  for (const auto& [name, factory] : factories_) result.push_back(name);
  return result;
}

Result<std::shared_ptr<const ReflectanceModel>> ModelRegistry::create(
    const ModelDescription& description) const {
  for (const auto& [name, factory] : factories_)
    if (name == description.name) return factory(description);
  return fail(fmt::format("unknown model '{}'", description.name), {},
              fmt::format("one of {}", fmt::join(names(), ", ")));
}

}  // namespace weft
