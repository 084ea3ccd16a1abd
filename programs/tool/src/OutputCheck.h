#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// The files and folders that are there among the words of a command line, NAME=FILE included.
std::vector<std::filesystem::path> existingFiles(const std::vector<std::string>& words);

/// Whether an output can be written and replaces no input: neither one of `inputs` nor, where that
/// is a folder or a list of photographs, a picture of it.
Result<void> checkOutputFile(const std::filesystem::path& output,
                             const std::vector<std::filesystem::path>& inputs);

/// Fails where stdout goes into an input, as with `>> FILE`.
Result<void> checkStdout(const std::vector<std::filesystem::path>& inputs);

/// Fails where two outputs are one file.
Result<void> checkDistinct(const std::vector<std::filesystem::path>& outputs);

}  // namespace weft
