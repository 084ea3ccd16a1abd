#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Sees to it that every member of a glTF file that Weft reads, those of its extensions included,
/// is of the type that the specification says, and that what must be there is: parsers skip what is
/// not.
///
/// Whole numbers that are written as others (48.0) become whole. A null counts as not there, with a
/// warning. Everything else of another type fails with the member's place.
Result<void> checkShape(nlohmann::ordered_json& file, const std::filesystem::path& path,
                        std::vector<std::string>& warnings);

}  // namespace weft
