#include "PngImage.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "ImageLimits.h"
#include "weft/core/Contract.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kSignatureBytes = 8;
constexpr std::uint64_t kMostDeflated = 1032;  // to 1: 258 bytes by two codes of a bit each

std::uint32_t bigEndian(Bytes bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[offset + i];
  return value;
}

/// What is found by going over a PNG's chunks, without unpacking any.
struct PngChunks {
  std::uint64_t pixelBytes = 0;  ///< packed
  Orientation orientation = Orientation::Upright;
};

PngChunks findChunks(Bytes bytes) {
  constexpr std::size_t kFrame = 12;  // length, name and checksum
  PngChunks chunks;
  for (std::size_t at = kSignatureBytes; bytes.size() - at >= kFrame;) {
    const std::size_t length = std::min<std::size_t>(bigEndian(bytes, at), bytes.size() - at - kFrame);
    const auto isNamed = [&](const char* name) { return std::memcmp(bytes.data() + at + 4, name, 4) == 0; };
    if (isNamed("IDAT")) chunks.pixelBytes += length;
    if (isNamed("eXIf")) chunks.orientation = exifOrientation(bytes.subspan(at + 8, length));
    at += kFrame + length;
  }
  return chunks;
}

/// libpng's reader of an image in memory. It takes rows as they are stored; the simplified
/// interface would apply gamma, and take 16 bits for linear.
class PngDecoder {
 public:
  explicit PngDecoder(Bytes bytes) : left_(bytes) {}
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }

  /// False where it fails, for the reason that failure() has.
  bool readHeader();
  /// Rows in memory, of the bytes that rowBytes() then says; `wide` as 16 bits, else as 8.
  bool prepareRows(bool wide);
  bool readRows(png_bytepp rows);
  tl::unexpected<Error> failure(const std::string& where) const;

  std::int64_t width() const { return png_get_image_width(png_, info_); }
  std::int64_t height() const { return png_get_image_height(png_, info_); }
  std::size_t rowBytes() const { return png_get_rowbytes(png_, info_); }
  bool isWide() const { return png_get_bit_depth(png_, info_) == 16; }
  int channels() const;

 private:
  static PngDecoder& of(png_structp png) { return *static_cast<PngDecoder*>(png_get_error_ptr(png)); }
  static void readBytes(png_structp png, png_bytep out, std::size_t count);
  [[noreturn]] static void leave(png_structp png, png_const_charp message);
  static void ignore(png_structp, png_const_charp) {}

  Bytes left_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::jmp_buf jump_{};
  std::array<char, 200> message_{};
};

void PngDecoder::readBytes(png_structp png, png_bytep out, std::size_t count) {
  PngDecoder& decoder = of(png);
  if (count > decoder.left_.size()) png_error(png, "it is truncated");
  std::copy_n(decoder.left_.begin(), count, out);
  decoder.left_ = decoder.left_.subspan(count);
}

void PngDecoder::leave(png_structp png, png_const_charp message) {
  PngDecoder& decoder = of(png);
  std::strncpy(decoder.message_.data(), message, decoder.message_.size() - 1);
  std::longjmp(decoder.jump_, 1);
}

bool PngDecoder::readHeader() {
  if (setjmp(jump_) != 0) return false;
  png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, leave, ignore);
  if (png_) info_ = png_create_info_struct(png_);
  if (!info_) return false;
  png_set_read_fn(png_, this, readBytes);
  png_set_benign_errors(png_, 1);
  // Gamma, profiles and texts, which may be large when unpacked, are not looked at; transparency
  // is.
  png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_read_info(png_, info_);
  return true;
}

bool PngDecoder::prepareRows(bool wide) {
  if (setjmp(jump_) != 0) return false;
  png_set_expand(png_);  // palettes, less than 8 bits, and a transparent colour to alpha
  if (!wide) png_set_scale_16(png_);
  if (wide && std::endian::native == std::endian::little) png_set_swap(png_);
  png_set_interlace_handling(png_);
  png_read_update_info(png_, info_);
  return true;
}

bool PngDecoder::readRows(png_bytepp rows) {
  if (setjmp(jump_) != 0) return false;
  png_read_image(png_, rows);
  return true;
}

tl::unexpected<Error> PngDecoder::failure(const std::string& where) const {
  const std::string reason = message_.data();
  if (!info_ || reason.find("memory") != reason.npos)
    return fail("there is not enough memory to read it", where);
  return fail("the PNG is damaged: " + reason, where);
}

int PngDecoder::channels() const {
  const int color = png_get_color_type(png_, info_);
  const bool isTransparent =
      (color & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
  return ((color & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1) + (isTransparent ? 1 : 0);
}

Result<ImageHeader> checkedHeader(PngDecoder& decoder, Bytes bytes, const std::string& where) {
  if (!decoder.readHeader()) return decoder.failure(where);
  WEFT_TRY_VOID(checkImageSize(decoder.width(), decoder.height(), where));
  const PngChunks chunks = findChunks(bytes);
  const ImageHeader header{static_cast<int>(decoder.width()), static_cast<int>(decoder.height()),
                           decoder.channels(), decoder.isWide(), chunks.orientation};
  // A row that is not interlaced begins with the number of its filter.
  if ((decoder.rowBytes() + 1) * static_cast<std::uint64_t>(header.height) >
      chunks.pixelBytes * kMostDeflated)
    return imageBeyondFile(header.width, header.height, bytes.size(), where);
  return header;
}

/// Whether all rows are there, by way of the memory of a single one.
bool hasAllRows(PngDecoder& decoder, const ImageHeader& header) {
  if (!decoder.prepareRows(false)) return false;
  Image row(header.width, 1, header.channels);
  std::vector<png_bytep> rows(static_cast<std::size_t>(header.height), row.bytes.data());
  return decoder.readRows(rows.data());
}

template <class Value>
Result<void> decode(Bytes bytes, std::span<Value> pixels, const std::string& where) {
  PngDecoder decoder(bytes);
  WEFT_TRY(const ImageHeader header, checkedHeader(decoder, bytes, where));
  WEFT_EXPECT(header.wide || sizeof(Value) == 1, "only a wide image has 16 bits");
  if (!decoder.prepareRows(sizeof(Value) == 2)) return decoder.failure(where);
  const std::size_t rowBytes = decoder.rowBytes();
  const auto height = static_cast<std::size_t>(header.height);
  WEFT_EXPECT(rowBytes * height == pixels.size_bytes(), "pixels hold the image");
  std::vector<png_bytep> rows(height);
  for (std::size_t y = 0; y < height; ++y)
    rows[y] = reinterpret_cast<png_bytep>(pixels.data()) + y * rowBytes;
  if (!decoder.readRows(rows.data())) return decoder.failure(where);
  return {};
}

struct PngImage : png_image {
  explicit PngImage(const Image& image) : png_image{} {
    constexpr std::array<png_uint_32, 4> formats{PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB,
                                                 PNG_FORMAT_RGBA};
    WEFT_EXPECT(image.channels >= 1 && image.channels <= 4, "a PNG has 1 to 4 channels");
    version = PNG_IMAGE_VERSION;
    width = static_cast<png_uint_32>(image.width);
    height = static_cast<png_uint_32>(image.height);
    format = formats[static_cast<std::size_t>(image.channels - 1)];
  }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(this); }
};

}  // namespace

bool isPng(Bytes bytes) {
  return bytes.size() > kSignatureBytes && png_sig_cmp(bytes.data(), 0, kSignatureBytes) == 0;
}

Result<ImageHeader> readPngHeader(Bytes bytes, const std::string& where) {
  PngDecoder decoder(bytes);
  WEFT_TRY(const ImageHeader header, checkedHeader(decoder, bytes, where));
  const std::uint64_t values = static_cast<std::uint64_t>(header.width) *
                               static_cast<std::uint64_t>(header.height) *
                               static_cast<std::uint64_t>(header.channels);
  // What is larger, and packed by more, is unpacked once before memory is taken for it.
  if (values > kFreeBytes + kUsualExpansion * bytes.size() && !hasAllRows(decoder, header))
    return decoder.failure(where);
  return header;
}

Result<void> decodePng(Bytes bytes, std::span<std::uint8_t> pixels, const std::string& where) {
  return decode(bytes, pixels, where);
}

Result<void> decodePng(Bytes bytes, std::span<std::uint16_t> pixels, const std::string& where) {
  return decode(bytes, pixels, where);
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

}  // namespace weft
