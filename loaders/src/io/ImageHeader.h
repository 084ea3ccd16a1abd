#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "ExifOrientation.h"
#include "weft/core/Result.h"

namespace weft {

/// What a JPEG or PNG says of itself, checked against the size of the file.
struct ImageHeader {
  int width = 0;  ///< as stored, before it is turned
  int height = 0;
  int channels = 0;   ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA, once a palette is looked up
  bool wide = false;  ///< 16 bits a channel
  Orientation orientation = Orientation::Upright;
};

/// Fails on more than 16384 pixels a side or 2^26 in all.
Result<void> checkImageSize(std::int64_t width, std::int64_t height, const std::string& where);

/// For an image that needs more bytes than its file has.
tl::unexpected<Error> imageBeyondFile(std::int64_t width, std::int64_t height, std::size_t fileBytes,
                                      const std::string& where);

}  // namespace weft
