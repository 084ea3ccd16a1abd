#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Image.h"
#include "weft/core/Result.h"

namespace weft {

struct ImageSize {
  int width = 0;
  int height = 0;
};

/// Decodes a JPEG or PNG, told by its first bytes, to as many 8-bit channels as it has (JPEG 1 or
/// 3, PNG 1 to 4, palettes and transparent colours looked up, 16 bits rounded). Values are as
/// stored: what a file says of gamma, colour profile and orientation is for those who know what the
/// image is for. Fails on damaged and truncated images, on CMYK, and, before memory is taken, on
/// more than 16384 pixels a side or 2^26 in all and on more pixels than the file can hold.
Result<Image> decodeImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// Whether an image is a PNG of 16 bits a channel; false of what is no image.
bool isWideImage(std::span<const std::uint8_t> bytes);

/// decodeImage() to 16 bits; 8 become 257 times the value.
Result<WideImage> decodeWideImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// What a photograph is, from its header alone.
struct PhotographHeader {
  ImageSize size;     ///< standing upright
  bool wide = false;  ///< a PNG of 16 bits a channel
};

/// Of a JPEG or PNG; fails like decodeImage().
Result<PhotographHeader> photographHeader(std::span<const std::uint8_t> bytes, const std::string& where);

/// Decodes a photograph that must be of this size to `rgb[row][column][rgb]`, turned upright as its
/// EXIF says: grey is repeated, alpha dropped. Fails like decodeImage().
Result<void> decodePhotograph(std::span<const std::uint8_t> bytes, ImageSize size,
                              std::span<std::uint8_t> rgb, const std::string& where);
/// The same of 16 bits; 8 become 257 times the value.
Result<void> decodePhotograph(std::span<const std::uint8_t> bytes, ImageSize size,
                              std::span<std::uint16_t> rgb, const std::string& where);

/// decodeImage() of a file.
Result<Image> readImage(const std::filesystem::path& path);

/// Baseline JPEG without chroma subsampling, of an image with 3 channels.
Result<std::vector<std::uint8_t>> encodeJpeg(const Image& image, int quality);

/// A PNG in memory, 8-bit values as they are.
Result<std::vector<std::uint8_t>> encodePng(const Image& image);

/// The channels R, G, B of a linear image as they are displayed: clamped to 0..1 and encoded as
/// sRGB. Fails where the image has no such channels.
Result<Image> displayImage(const FloatImage& linear);

/// Writes 8-bit values as they are; beside the place, then renamed.
Result<void> writePng(const std::filesystem::path& path, const Image& image);

/// Writes displayImage() of a linear image.
Result<void> writePng(const std::filesystem::path& path, const FloatImage& linear);

}  // namespace weft
