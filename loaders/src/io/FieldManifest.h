#pragma once

#include <string>
#include <vector>

#include "weft/core/Result.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// The JSON text in the header of a reflectance field file: everything but the numbers
/// (docs/file-format.md).
struct FieldManifest {
  struct Size {
    int width = 0;
    int height = 0;
    bool operator==(const Size&) const = default;
  };

  ModelDescription model;
  ReflectanceFieldDescription field;
  std::vector<Size> levels;         ///< empty: one, as large as the file's first part (manifest 2)
  std::vector<std::string> tables;  ///< names

  static FieldManifest of(const ReflectanceField& field);
  /// Fails where the fit report is not JSON.
  Result<std::string> text() const;
  /// Reads versions 2 and 3. `models` says which of version 2's options a model has.
  static Result<FieldManifest> parse(const std::string& text, const ModelRegistry& models);
};

}  // namespace weft
