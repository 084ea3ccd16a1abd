#pragma once

#include "ImageHeader.h"

namespace weft {

bool isPng(std::span<const std::uint8_t> bytes);

/// Fails on damaged headers, and where the file has fewer bytes than any picture of its size packs
/// into.
Result<ImageHeader> readPngHeader(std::span<const std::uint8_t> bytes, const std::string& where);

/// Decodes to `pixels[row][column][channel]` with the header's channels. Values are as stored,
/// whatever the file says of gamma and colour; fewer than 8 bits are scaled up, 16 to 8 down.
Result<void> decodePng(std::span<const std::uint8_t> bytes, std::span<std::uint8_t> pixels,
                       const std::string& where);

/// The same of 16 bits a channel, for a header that is wide.
Result<void> decodePng(std::span<const std::uint8_t> bytes, std::span<std::uint16_t> pixels,
                       const std::string& where);

}  // namespace weft
