#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Encoded images larger than this are refused before memory is taken.
constexpr std::size_t kLargestImageFile = std::size_t{256} << 20;

/// The size of a regular file. Fails, with the file and the system's reason, where it is missing,
/// may not be looked at or is none: a FIFO would be waited for.
Result<std::uint64_t> regularFileSize(const std::filesystem::path& path);

/// The bytes of a whole file; fails, with file and reason, where it is missing, unreadable, no
/// regular file or larger than `limit` bytes, which is found before memory is taken.
Result<std::vector<std::uint8_t>> readFileBytes(const std::filesystem::path& path, std::size_t limit);

/// The first bytes of a file, or all where it has fewer: what tells its kind (FileKind.h). Fails
/// likewise.
Result<std::vector<std::uint8_t>> readFileStart(const std::filesystem::path& path, std::size_t count);

}  // namespace weft
