#include "weft/reflectance/FieldTables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "weft/reflectance/ReflectanceModel.h"

namespace weft {
namespace {

std::string sizeOf(int width, int height) {
  const auto side = [](int length) { return length == 0 ? std::string("any") : std::to_string(length); };
  return side(width) + " x " + side(height);
}

Result<void> checkTable(const ModelTable& declared, const FloatImage& table) {
  if (table.channels() != declared.channels)
    return fail(fmt::format("the channels of the table '{}' are not those of the model", declared.name));
  const bool fits = (declared.width == 0 || declared.width == table.width()) &&
                    (declared.height == 0 || declared.height == table.height()) && table.layers() == 1;
  if (!fits)
    return fail(fmt::format("the table '{}' has {} texels in {} layers, the model needs {} in one",
                            declared.name, sizeOf(table.width(), table.height()), table.layers(),
                            sizeOf(declared.width, declared.height)));
  if (!std::ranges::all_of(table.values(), [](float value) { return std::isfinite(value); }))
    return fail(fmt::format("a number of the table '{}' is not finite", declared.name));
  return {};
}

}  // namespace

Result<std::shared_ptr<const ReflectanceModel>> boundModel(std::shared_ptr<const ReflectanceModel> model,
                                                           std::shared_ptr<const FieldTables> tables) {
  const std::vector<ModelTable> declared = model->tables();
  const std::string& name = model->description().name;
  for (const auto& [table, image] : *tables)
    if (std::ranges::find(declared, table, &ModelTable::name) == declared.end())
      return fail(fmt::format("the model '{}' has no table '{}'", name, table));
  for (const ModelTable& table : declared) {
    const auto found = tables->find(table.name);
    if (found == tables->end())
      return fail(fmt::format("the table '{}' of the model '{}' is missing", table.name, name));
    WEFT_TRY_VOID(checkTable(table, found->second));
  }
  if (declared.empty()) return model;
  return model->bind(std::move(tables));
}

}  // namespace weft
