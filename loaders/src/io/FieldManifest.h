#pragma once

#include <string>

#include "weft/core/Result.h"
#include "weft/reflectance/ReflectanceField.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// The JSON text in the header of a reflectance field file: everything but the numbers (docs/file-format.md).
struct FieldManifest {
  ModelDescription model;
  ReflectanceFieldDescription field;

  /// Fails where the fit report is not JSON.
  Result<std::string> text() const;
  static Result<FieldManifest> parse(const std::string& text);
};

}  // namespace weft
