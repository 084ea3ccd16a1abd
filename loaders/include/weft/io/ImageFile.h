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

/// The size of a JPEG or PNG, from its header alone. `where` names the source in failures.
Result<ImageSize> imageSize(std::span<const std::uint8_t> bytes, const std::string& where);

/// Decodes a JPEG or PNG, told by its first bytes, to as many 8-bit channels as it has (JPEG 1 or 3, PNG 1 to
/// 4; 16-bit PNGs and palettes are converted). Fails on damaged and truncated images, and on more than 16384
/// pixels a side or 2^26 in all, before memory is taken.
Result<Image> decodeImage(std::span<const std::uint8_t> bytes, const std::string& where);

/// Decodes a JPEG or PNG that must be of this size to `rgb[row][column][rgb]`: grey is repeated, alpha
/// dropped. Fails like decodeImage().
Result<void> decodeRgb(std::span<const std::uint8_t> bytes, ImageSize size, std::span<std::uint8_t> rgb,
                       const std::string& where);

/// decodeImage() of a file.
Result<Image> readImage(const std::filesystem::path& path);

/// Baseline JPEG without chroma subsampling, of an image with 3 channels.
Result<std::vector<std::uint8_t>> encodeJpeg(const Image& image, int quality);

/// A PNG in memory, 8-bit values as they are.
Result<std::vector<std::uint8_t>> encodePng(const Image& image);

/// The channels R, G, B of a linear image as they are displayed: clamped to 0..1 and encoded as sRGB.
/// Fails where the image has no such channels.
Result<Image> displayImage(const FloatImage& linear);

/// Writes 8-bit values as they are; beside the place, then renamed.
Result<void> writePng(const std::filesystem::path& path, const Image& image);

/// Writes displayImage() of a linear image.
Result<void> writePng(const std::filesystem::path& path, const FloatImage& linear);

}  // namespace weft
