#include "weft/io/ImageFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "JpegImage.h"
#include "PngImage.h"
#include "weft/core/AtomicFile.h"
#include "weft/core/Color.h"
#include "weft/core/Contract.h"
#include "weft/core/FileKind.h"
#include "weft/io/FileBytes.h"
#include "weft/io/WithinMemory.h"

namespace weft {
namespace {

using Bytes = std::span<const std::uint8_t>;

Result<ImageHeader> readHeader(Bytes bytes, const std::string& where) {
  if (isJpeg(bytes)) return readJpegHeader(bytes, where);
  if (isPng(bytes)) return readPngHeader(bytes, where);
  return failOtherKind(fileKind(bytes), "a JPEG or PNG image", where);
}

ImageSize uprightSize(const ImageHeader& header) {
  ImageSize size{header.width, header.height};
  if (swapsSides(header.orientation)) std::swap(size.width, size.height);
  return size;
}

Result<void> checkSameSize(ImageSize actual, ImageSize expected, const std::string& where) {
  if (actual.width == expected.width && actual.height == expected.height) return {};
  return fail(fmt::format("the image has {} x {} pixels, the others have {} x {}", actual.width,
                          actual.height, expected.width, expected.height),
              where);
}

std::size_t valueCount(const ImageHeader& header) {
  return static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) *
         static_cast<std::size_t>(header.channels);
}

Result<void> decodeStored(Bytes bytes, const ImageHeader& header, std::span<std::uint8_t> values,
                          const std::string& where) {
  return isPng(bytes) ? decodePng(bytes, values, where) : decodeJpeg(bytes, header.channels, values, where);
}

Result<void> decodeStored(Bytes bytes, const ImageHeader& header, std::span<std::uint16_t> values,
                          const std::string& where) {
  if (header.wide) return decodePng(bytes, values, where);
  std::vector<std::uint8_t> narrow(values.size());
  WEFT_TRY_VOID(decodeStored(bytes, header, narrow, where));
  std::ranges::transform(narrow, values.begin(),
                         [](std::uint8_t value) { return static_cast<std::uint16_t>(257 * value); });
  return {};
}

/// Where a pixel of the upright image is stored.
struct Place {
  int x;
  int y;
};

Place storedPlace(const ImageHeader& header, Place upright) {
  const auto [x, y] = upright;
  const int right = header.width - 1, bottom = header.height - 1;
  switch (header.orientation) {
    case Orientation::Upright:
      return {x, y};
    case Orientation::Mirrored:
      return {right - x, y};
    case Orientation::UpsideDown:
      return {right - x, bottom - y};
    case Orientation::MirroredUpsideDown:
      return {x, bottom - y};
    case Orientation::Transposed:
      return {y, x};
    case Orientation::TurnRight:
      return {y, bottom - x};
    case Orientation::TransposedUpsideDown:
      return {right - y, bottom - x};
    case Orientation::TurnLeft:
      return {right - y, x};
  }
  return {x, y};
}

template <class Value>
void copyUpright(const ImageHeader& header, std::span<const Value> stored, std::span<Value> rgb) {
  const auto [width, height] = uprightSize(header);
  const auto channels = static_cast<std::size_t>(header.channels);
  Value* to = rgb.data();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Place place = storedPlace(header, {x, y});
      const Value* from =
          stored.data() + (static_cast<std::size_t>(place.y) * static_cast<std::size_t>(header.width) +
                           static_cast<std::size_t>(place.x)) *
                              channels;
      for (std::size_t c = 0; c < 3; ++c) *to++ = from[channels < 3 ? 0 : c];
    }
}

template <class Value>
Result<void> decodeUpright(Bytes bytes, ImageSize size, std::span<Value> rgb, const std::string& where) {
  WEFT_EXPECT(rgb.size() == 3 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height),
              "rgb holds the image");
  return withinMemory(where, [&]() -> Result<void> {
    WEFT_TRY(const ImageHeader header, readHeader(bytes, where));
    WEFT_TRY_VOID(checkSameSize(uprightSize(header), size, where));
    if constexpr (sizeof(Value) == 1)
      if (isJpeg(bytes) && header.orientation == Orientation::Upright)
        return decodeJpeg(bytes, 3, rgb, where);
    std::vector<Value> stored(valueCount(header));
    WEFT_TRY_VOID(decodeStored(bytes, header, std::span(stored), where));
    copyUpright(header, std::span<const Value>(stored), rgb);
    return {};
  });
}

}  // namespace

Result<Image> decodeImage(Bytes bytes, const std::string& where) {
  return withinMemory(where, [&]() -> Result<Image> {
    WEFT_TRY(const ImageHeader header, readHeader(bytes, where));
    Image image(header.width, header.height, header.channels);
    WEFT_TRY_VOID(decodeStored(bytes, header, std::span(image.bytes), where));
    return image;
  });
}

bool isWideImage(Bytes bytes) {
  const auto header = isPng(bytes) ? readPngHeader(bytes, {}) : Result<ImageHeader>();
  return header && header->wide;
}

Result<WideImage> decodeWideImage(Bytes bytes, const std::string& where) {
  return withinMemory(where, [&]() -> Result<WideImage> {
    WEFT_TRY(const ImageHeader header, readHeader(bytes, where));
    WideImage image{header.width, header.height, header.channels,
                    std::vector<std::uint16_t>(valueCount(header))};
    WEFT_TRY_VOID(decodeStored(bytes, header, std::span(image.words), where));
    return image;
  });
}

Result<PhotographHeader> photographHeader(Bytes bytes, const std::string& where) {
  WEFT_TRY(const ImageHeader header, readHeader(bytes, where));
  return PhotographHeader{uprightSize(header), header.wide};
}

Result<void> decodePhotograph(Bytes bytes, ImageSize size, std::span<std::uint8_t> rgb,
                              const std::string& where) {
  return decodeUpright(bytes, size, rgb, where);
}

Result<void> decodePhotograph(Bytes bytes, ImageSize size, std::span<std::uint16_t> rgb,
                              const std::string& where) {
  return decodeUpright(bytes, size, rgb, where);
}

Result<Image> readImage(const std::filesystem::path& path) {
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestImageFile));
  return decodeImage(bytes, path.string());
}

Result<void> writePng(const std::filesystem::path& path, const Image& image) {
  WEFT_TRY(const std::vector<std::uint8_t> bytes, encodePng(image));
  return writeWholeFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<Image> displayImage(const FloatImage& linear) {
  std::array<int, 3> channels{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto index = linear.channelIndex(std::string(1, "RGB"[i]));
    if (!index) return fail("the image has no channels R, G, B");
    channels[i] = *index;
  }
  Image image(linear.width(), linear.height(), 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (std::size_t i = 0; i < 3; ++i) {
        const float stored = encode(Encoding::Srgb, linear.at(x, y, channels[i]));
        const float shown = stored > 0.0f ? std::min(stored, 1.0f) : 0.0f;  // NaN is shown black
        image.pixel(x, y)[i] = static_cast<std::uint8_t>(std::lround(255.0f * shown));
      }
  return image;
}

Result<void> writePng(const std::filesystem::path& path, const FloatImage& linear) {
  WEFT_TRY(const Image image, displayImage(linear));
  return writePng(path, image);
}

}  // namespace weft
