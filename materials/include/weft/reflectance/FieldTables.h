#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

class ReflectanceModel;

/// Tables that all texels of a field share, by name: images of one layer.
using FieldTables = std::map<std::string, FloatImage>;

/// A table that a model declares.
struct ModelTable {
  std::string name;  ///< letters, digits and '_', also of the GLSL's define TABLE_NAME
  std::vector<std::string> channels;
  int width = 0;            ///< 0: any
  int height = 0;           ///< likewise
  bool isFiltered = false;  ///< the GLSL looks between its texels
};

/// The model that evaluates with these tables; a model without tables itself. Fails where a table
/// is missing, of another shape than declared, not finite, or not the model's at all.
Result<std::shared_ptr<const ReflectanceModel>> boundModel(std::shared_ptr<const ReflectanceModel> model,
                                                           std::shared_ptr<const FieldTables> tables);

}  // namespace weft
