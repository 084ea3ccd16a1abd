#include "weft/io/PictureFile.h"

#include <algorithm>

#include "weft/core/FileKind.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/io/ExrFile.h"
#include "weft/io/FileBytes.h"
#include "weft/io/ImageFile.h"
#include "weft/io/WithinMemory.h"

namespace weft {
namespace {

/// Grey as R, G and B, all the same.
FloatImage withColors(FloatImage image) {
  if (image.channelCount() == 3) return image;
  FloatImage colors(image.width(), image.height(), {"R", "G", "B"});
  for (std::size_t i = 0; i < colors.values().size(); ++i) colors.values()[i] = image.values()[i / 3];
  return colors;
}

/// Of 16 bits as 0 to 1, on black where it is transparent.
FloatImage onBlack(const WideImage& image, std::vector<std::string>& warnings) {
  FloatImage result(image.width, image.height, {"R", "G", "B"});
  const bool hasAlpha = image.channels % 2 == 0;
  const auto channels = static_cast<std::size_t>(image.channels);
  bool transparent = false;
  for (std::size_t pixel = 0; pixel < result.values().size() / 3; ++pixel) {
    const std::uint16_t* from = image.words.data() + pixel * channels;
    const float alpha = hasAlpha ? static_cast<float>(from[channels - 1]) / 65535.0f : 1.0f;
    transparent = transparent || alpha < 1.0f;
    for (std::size_t c = 0; c < 3; ++c)
      result.values()[3 * pixel + c] = static_cast<float>(from[channels < 3 ? 0 : c]) / 65535.0f * alpha;
  }
  if (transparent) warnings.emplace_back("what is transparent is laid on black");
  return result;
}

Result<Picture> decodeStoredPicture(std::span<const std::uint8_t> bytes, const std::string& where,
                                    std::vector<std::string>& warnings) {
  if (fileKind(bytes) == FileKind::Png) {
    WEFT_TRY(const WideImage image, decodeWideImage(bytes, where));
    return Picture{onBlack(image, warnings), Encoding::Srgb};
  }
  WEFT_TRY(const PhotographHeader header, photographHeader(bytes, where));
  WideImage image{header.size.width, header.size.height, 3, {}};
  image.words.resize(3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  WEFT_TRY_VOID(decodePhotograph(bytes, header.size, std::span(image.words), where));
  return Picture{onBlack(image, warnings), Encoding::Srgb};
}

}  // namespace

Result<FloatImage> readLinearPicture(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  WEFT_TRY(const std::vector<std::uint8_t> start, readFileStart(path, kFileKindBytes));
  const FileKind kind = fileKind(start);
  if (kind == FileKind::Exr) return readExrPicture(path, warnings);
  if (kind != FileKind::Radiance)
    return failOtherKind(kind, "a Radiance (.hdr) or OpenEXR picture", path.string());
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestImageFile));
  return decodeRadiance(bytes, path.string(), warnings);
}

Result<Picture> readPicture(const std::filesystem::path& path, std::vector<std::string>& warnings) {
  return withinMemory(path.string(), [&]() -> Result<Picture> {
    WEFT_TRY(const std::vector<std::uint8_t> start, readFileStart(path, kFileKindBytes));
    const FileKind kind = fileKind(start);
    if (kind == FileKind::Exr || kind == FileKind::Radiance) {
      WEFT_TRY(FloatImage image, readLinearPicture(path, warnings));
      return Picture{withColors(std::move(image)), Encoding::Linear};
    }
    if (kind != FileKind::Png && kind != FileKind::Jpeg)
      return failOtherKind(kind, "a picture (PNG, JPEG, OpenEXR or Radiance)", path.string());
    WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestImageFile));
    return decodeStoredPicture(bytes, path.string(), warnings);
  });
}

}  // namespace weft
