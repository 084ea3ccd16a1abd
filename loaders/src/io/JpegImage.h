#pragma once

#include "ImageHeader.h"
#include "weft/core/Image.h"

namespace weft {

bool isJpeg(std::span<const std::uint8_t> bytes);

/// Fails on damaged headers, on CMYK and other kinds that are not grey or RGB with 8 bits, and
/// where the file has fewer bits than any picture of its size needs.
Result<ImageHeader> readJpegHeader(std::span<const std::uint8_t> bytes, const std::string& where);

/// Decodes to `pixels[row][column][channel]` of 1 or 3 channels, as stored; the size is the
/// header's.
Result<void> decodeJpeg(std::span<const std::uint8_t> bytes, int channels, std::span<std::uint8_t> pixels,
                        const std::string& where);

}  // namespace weft
