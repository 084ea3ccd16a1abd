#include "weft/reflectance/ModelRegistry.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "weft/reflectance/BumpModel.h"
#include "weft/reflectance/LafModel.h"
#include "weft/reflectance/LodModel.h"
#include "weft/reflectance/LoomModel.h"
#include "weft/reflectance/RfnlModel.h"
#include "weft/reflectance/RfpModel.h"

namespace weft {

ModelRegistry ModelRegistry::builtin() {
  ModelRegistry registry;
  for (const auto& types :
       {RfpModel::types(), RfnlModel::types(), LafModel::types(), BumpModel::types(), LoomModel::types()})
    for (const ModelType& type : types) registry.add(type);
  registry.add(LodModel::type());
  return registry;
}

void ModelRegistry::add(ModelType type) {
  const auto same = std::ranges::find(types_, type.name, &ModelType::name);
  if (same == types_.end())
    types_.push_back(std::move(type));
  else
    *same = std::move(type);
}

std::vector<std::string> ModelRegistry::names() const {
  std::vector<std::string> result;
  for (const ModelType& type : types_) result.push_back(type.name);
  return result;
}

Result<ModelType> ModelRegistry::find(std::string_view name) const {
  const auto found = std::ranges::find(types_, name, &ModelType::name);
  if (found == types_.end())
    return fail(fmt::format("unknown model '{}'", name), {},
                fmt::format("known are {}", fmt::join(names(), ", ")));
  return *found;
}

Result<std::shared_ptr<const ReflectanceModel>> ModelRegistry::create(
    const ModelDescription& description) const {
  WEFT_TRY(const ModelType type, find(description.name));
  WEFT_TRY(ModelOptions options, ModelOptions::create(description, type.options));
  return type.make(std::move(options));
}

}  // namespace weft
