#pragma once

#include <filesystem>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// Reads the first part of an OpenEXR file, scan lines or tiles, whatever its compression: all its channels,
/// in the file's (alphabetical) order, half or float, and its text attributes as metadata.
///
/// Row 0 is the top of the data window. Fails, with file and reason, on damaged files, on integer, subsampled
/// and deep channels, and on sizes that the file cannot hold, before memory is taken.
Result<FloatImage> readExr(const std::filesystem::path& path);

/// Writes an image of one layer, its precision and metadata, without loss (ZIP); beside the place, then
/// renamed.
Result<void> writeExr(const std::filesystem::path& path, const FloatImage& image);

}  // namespace weft
