#pragma once

#include <filesystem>

#include "weft/core/Result.h"
#include "weft/reflectance/ModelRegistry.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// Writes a `.rf.exr` (docs/file-format.md): for each level the part `shared` and one part a view,
/// then the tables. Written beside its place and renamed. All threads pack, and the bytes do not
/// depend on how many; what is packed of 64 parts is held in memory.
Result<void> writeReflectanceField(const ReflectanceField& field, const std::filesystem::path& path);

/// Reads it back, and files of older versions. Fails, with file and reason, on anything that is not
/// such a file, and where `models` lacks the file's model, listing those it has; sizes are checked
/// before memory is taken.
Result<ReflectanceField> readReflectanceField(const std::filesystem::path& path,
                                              const ModelRegistry& models = ModelRegistry::builtin());

}  // namespace weft
