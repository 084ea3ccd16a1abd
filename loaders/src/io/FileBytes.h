#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Encoded images larger than this are refused before memory is taken.
constexpr std::size_t kLargestImageFile = std::size_t{256} << 20;

/// A whole file; fails where it is missing, unreadable or larger than `limit`.
Result<std::vector<std::uint8_t>> readFileBytes(const std::filesystem::path& path, std::size_t limit);

}  // namespace weft
