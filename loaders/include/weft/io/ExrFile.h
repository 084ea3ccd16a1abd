#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// Reads the first part of an OpenEXR file, scan lines or tiles, whatever its compression: all its
/// channels, in the file's (alphabetical) order, half or float, and its text attributes as
/// metadata.
///
/// Row 0 is the top of the data window. Fails, with file and reason, on damaged files, on integer,
/// subsampled and deep channels, and on sizes that the file cannot hold, before memory is taken.
Result<FloatImage> readExr(const std::filesystem::path& path);

/// Reads the picture that an OpenEXR file shows: channels R, G, B in linear Rec. 709, or Y alone
/// for grey, of the display window, black where the file has no pixels.
///
/// Of many parts and layers it takes the one with the picture, never depth; luminance with chroma
/// becomes RGB, and other primaries (chromaticities) Rec. 709. What is assumed and left out is
/// added to `warnings`. Fails like readExr(), and where there is no picture or it is not clear
/// which of several is meant, on cube maps, and on more than 2^26 pixels.
Result<FloatImage> readExrPicture(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// Writes an image of one layer, its precision and metadata, without loss (ZIP); beside the place,
/// then renamed.
Result<void> writeExr(const std::filesystem::path& path, const FloatImage& image);

}  // namespace weft
