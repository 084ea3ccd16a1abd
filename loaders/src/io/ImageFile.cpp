#include "weft/io/ImageFile.h"

#include <fmt/format.h>
#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "weft/core/AtomicFile.h"
#include "weft/core/Color.h"
#include "weft/core/Contract.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::int64_t kLargestSide = 16384;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;

struct DestroyTurboJpeg {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using TurboJpeg = std::unique_ptr<void, DestroyTurboJpeg>;

struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  explicit PngImage(const Image& image) : PngImage() {
    constexpr std::array<png_uint_32, 4> formats{PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                                 PNG_FORMAT_RGBA};
    WEFT_EXPECT(image.channels >= 1 && image.channels <= 4, "a PNG has 1 to 4 channels");
    width = static_cast<png_uint_32>(image.width);
    height = static_cast<png_uint_32>(image.height);
    format = formats[static_cast<std::size_t>(image.channels - 1)];
  }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

bool isJpeg(Bytes bytes) {
  return bytes.size() > 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

bool isPng(Bytes bytes) {
  return bytes.size() > 8 && png_sig_cmp(bytes.data(), 0, 8) == 0;
}

Result<void> checkSize(std::int64_t width, std::int64_t height, const std::string& where) {
  if (width > 0 && height > 0 && width <= kLargestSide && height <= kLargestSide &&
      width * height <= kMostPixels)
    return {};
  return fail(fmt::format("an image of {} x {} pixels is not supported", width, height), where,
              fmt::format("at most {} a side and {} in all", kLargestSide, kMostPixels));
}

Result<void> checkSameSize(ImageSize actual, ImageSize expected, const std::string& where) {
  if (actual.width == expected.width && actual.height == expected.height) return {};
  return fail(fmt::format("the image has {} x {} pixels, the others have {} x {}", actual.width,
                          actual.height, expected.width, expected.height),
              where);
}

tl::unexpected<Error> notAnImage(const std::string& where) {
  return fail("this is neither a JPEG nor a PNG", where);
}

struct JpegHeader {
  int width = 0;
  int height = 0;
  bool grey = false;
};

Result<JpegHeader> readJpegHeader(tjhandle decoder, Bytes bytes, const std::string& where) {
  JpegHeader header;
  int subsampling = 0;
  int colorSpace = 0;
  if (!decoder || tjDecompressHeader3(decoder, bytes.data(), bytes.size(), &header.width, &header.height,
                                      &subsampling, &colorSpace) != 0)
    return fail(fmt::format("the JPEG is damaged: {}", tjGetErrorStr2(decoder)), where);
  WEFT_TRY_VOID(checkSize(header.width, header.height, where));
  header.grey = colorSpace == TJCS_GRAY;
  return header;
}

Result<void> decodePixels(tjhandle decoder, const JpegHeader& header, Bytes bytes, TJPF format,
                          std::uint8_t* pixels, const std::string& where) {
  if (tjDecompress2(decoder, bytes.data(), bytes.size(), pixels, header.width, 0, header.height, format,
                    TJFLAG_LIMITSCANS) != 0)
    return fail(fmt::format("the JPEG is damaged: {}", tjGetErrorStr2(decoder)), where);
  return {};
}

// Every image gets a decoder of its own: one that is used again would lend its tables to an image that lacks
// them, so that the result depended on what was decoded before. It costs 2 % of decoding 256 x 256 pixels.
Result<Image> decodeJpeg(Bytes bytes, const std::string& where) {
  const TurboJpeg decoder(tjInitDecompress());
  WEFT_TRY(const JpegHeader header, readJpegHeader(decoder.get(), bytes, where));
  Image image(header.width, header.height, header.grey ? 1 : 3);
  WEFT_TRY_VOID(decodePixels(decoder.get(), header, bytes, header.grey ? TJPF_GRAY : TJPF_RGB,
                             image.bytes.data(), where));
  return image;
}

Result<void> readPngHeader(PngImage& png, Bytes bytes, const std::string& where) {
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
    return fail(fmt::format("the PNG is damaged: {}", png.message), where);
  return checkSize(png.width, png.height, where);
}

Result<Image> decodePng(Bytes bytes, const std::string& where) {
  PngImage png;
  WEFT_TRY_VOID(readPngHeader(png, bytes, where));
  png.format &= PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_ALPHA;  // 8 bits, no palette
  Image image(static_cast<int>(png.width), static_cast<int>(png.height),
              static_cast<int>(PNG_IMAGE_SAMPLE_CHANNELS(png.format)));
  if (!png_image_finish_read(&png, nullptr, image.bytes.data(), 0, nullptr))
    return fail(fmt::format("the PNG is damaged: {}", png.message), where);
  return image;
}

}  // namespace

Result<ImageSize> imageSize(Bytes bytes, const std::string& where) {
  if (isJpeg(bytes)) {
    const TurboJpeg decoder(tjInitDecompress());
    WEFT_TRY(const JpegHeader header, readJpegHeader(decoder.get(), bytes, where));
    return ImageSize{header.width, header.height};
  }
  if (!isPng(bytes)) return notAnImage(where);
  PngImage png;
  WEFT_TRY_VOID(readPngHeader(png, bytes, where));
  return ImageSize{static_cast<int>(png.width), static_cast<int>(png.height)};
}

Result<Image> decodeImage(Bytes bytes, const std::string& where) {
  if (isJpeg(bytes)) return decodeJpeg(bytes, where);
  if (isPng(bytes)) return decodePng(bytes, where);
  return notAnImage(where);
}

Result<void> decodeRgb(Bytes bytes, ImageSize size, std::span<std::uint8_t> rgb, const std::string& where) {
  WEFT_EXPECT(rgb.size() == 3 * static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height),
              "rgb holds the image");
  if (isJpeg(bytes)) {
    const TurboJpeg decoder(tjInitDecompress());
    WEFT_TRY(const JpegHeader header, readJpegHeader(decoder.get(), bytes, where));
    WEFT_TRY_VOID(checkSameSize({header.width, header.height}, size, where));
    return decodePixels(decoder.get(), header, bytes, TJPF_RGB, rgb.data(), where);
  }
  WEFT_TRY(const ImageSize actual, imageSize(bytes, where));
  WEFT_TRY_VOID(checkSameSize(actual, size, where));
  WEFT_TRY(const Image image, decodeImage(bytes, where));
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::uint8_t* from = image.bytes.data();
  for (std::size_t i = 0; i < rgb.size(); i += 3, from += channels)
    for (std::size_t c = 0; c < 3; ++c) rgb[i + c] = from[channels < 3 ? 0 : c];
  return {};
}

Result<Image> readImage(const std::filesystem::path& path) {
  WEFT_TRY(const std::vector<std::uint8_t> bytes, readFileBytes(path, kLargestImageFile));
  return decodeImage(bytes, path.string());
}

Result<std::vector<std::uint8_t>> encodeJpeg(const Image& image, int quality) {
  WEFT_EXPECT(image.channels == 3, "a JPEG is written from RGB");
  const TurboJpeg encoder(tjInitCompress());
  if (!encoder) return fail("out of memory for the JPEG encoder");
  std::vector<std::uint8_t> bytes(tjBufSize(image.width, image.height, TJSAMP_444));
  unsigned char* buffer = bytes.data();
  unsigned long size = bytes.size();
  if (tjCompress2(encoder.get(), image.bytes.data(), image.width, 0, image.height, TJPF_RGB, &buffer, &size,
                  TJSAMP_444, quality, TJFLAG_NOREALLOC) != 0)
    return fail(fmt::format("JPEG encoding failed: {}", tjGetErrorStr2(encoder.get())));
  bytes.resize(size);
  return bytes;
}

Result<std::vector<std::uint8_t>> encodePng(const Image& image) {
  PngImage png(image);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::uint8_t> bytes(size);
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.bytes.data(), 0, nullptr))
    return fail(fmt::format("PNG encoding failed: {}", png.message));
  bytes.resize(size);
  return bytes;
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
