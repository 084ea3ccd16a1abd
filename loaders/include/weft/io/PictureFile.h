#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/core/Color.h"
#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"

namespace weft {

/// A picture with its values as the file has them: channels R, G and B.
struct Picture {
  FloatImage image;
  Encoding encoding = Encoding::Srgb;  ///< sRGB, of 0 to 1, or linear
};

/// Reads what shows a picture, told by its first bytes: PNG and JPEG, whose values are taken for
/// sRGB, OpenEXR and Radiance, which are linear. Grey is repeated; a JPEG stands upright; what a
/// PNG has of transparency is laid on black, where the others have it already.
///
/// What is assumed is added to `warnings`. Fails, with file and reason, as decodeImage(),
/// readExrPicture() and decodeRadiance() do.
Result<Picture> readPicture(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// The same of OpenEXR and Radiance alone, to channels R, G, B or Y.
Result<FloatImage> readLinearPicture(const std::filesystem::path& path, std::vector<std::string>& warnings);

}  // namespace weft
