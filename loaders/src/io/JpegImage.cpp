#include "JpegImage.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <memory>

#include "ImageLimits.h"
#include "weft/core/Contract.h"
#include "weft/io/ImageFile.h"

// Needs <cstdio> before it.
#include <jerror.h>
#include <jpeglib.h>

namespace weft {
namespace {

using Bytes = std::span<const std::uint8_t>;

// A progressive JPEG is decoded as a whole for each of its scans, of which a small file may claim
// many.
constexpr int kMostScans = 500;

/// What libjpeg has to say, and where it then goes on.
struct Failure : jpeg_error_mgr {
  std::jmp_buf jump;
  std::array<char, JMSG_LENGTH_MAX> message;
};

[[noreturn]] void leave(j_common_ptr jpeg) {
  auto* failure = static_cast<Failure*>(jpeg->err);
  failure->format_message(jpeg, failure->message.data());
  std::longjmp(failure->jump, 1);
}

/// Whether a warning leaves all pixels as they are: cameras write a wrong spectral selection, and
/// bytes between the last row and the end.
bool isHarmless(const jpeg_error_mgr& warning) {
  switch (warning.msg_code) {
    case JWRN_JFIF_MAJOR:
    case JWRN_NOT_SEQUENTIAL:
      return true;
    case JWRN_EXTRANEOUS_DATA:
      return warning.msg_parm.i[1] == JPEG_EOI;
    default:
      return false;
  }
}

bool isUnsupported(int message) {
  constexpr std::array kinds{JERR_BAD_PRECISION, JERR_SOF_UNSUPPORTED, JERR_CONVERSION_NOTIMPL,
                             JERR_ARITH_NOTIMPL, JERR_CCIR601_NOTIMPL, JERR_FRACT_SAMPLE_NOTIMPL,
                             JERR_EMPTY_IMAGE};
  return std::ranges::find(kinds, message) != kinds.end();
}

/// Every image gets a decoder of its own: one that is used again would lend its tables to an image
/// that lacks them, so that the result depended on what was decoded before. It costs 2 % of
/// decoding 256 x 256 pixels.
class JpegDecoder {
 public:
  JpegDecoder() {
    jpeg_.err = jpeg_std_error(&failure_);
    failure_.error_exit = leave;
    failure_.emit_message = [](j_common_ptr jpeg, int level) {
      if (level < 0 && !isHarmless(*jpeg->err)) leave(jpeg);
    };
    progress_.progress_monitor = [](j_common_ptr jpeg) {
      if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
      jpeg->err->msg_code = JERR_BAD_PROGRESSION;
      leave(jpeg);
    };
  }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg_); }

  const jpeg_decompress_struct& header() const { return jpeg_; }
  /// False where it fails, for the reason that failure() has.
  bool readHeader(Bytes bytes);
  bool readPixels(J_COLOR_SPACE colors, std::uint8_t* pixels);
  tl::unexpected<Error> failure(const std::string& where) const;

 private:
  void readRows(std::uint8_t* pixels);

  jpeg_decompress_struct jpeg_{};
  jpeg_progress_mgr progress_{};
  Failure failure_{};
};

bool JpegDecoder::readHeader(Bytes bytes) {
  if (setjmp(failure_.jump) != 0) return false;
  jpeg_create_decompress(&jpeg_);
  jpeg_.progress = &progress_;
  jpeg_mem_src(&jpeg_, bytes.data(), bytes.size());
  jpeg_save_markers(&jpeg_, JPEG_APP0 + 1, 0xffff);  // EXIF
  jpeg_read_header(&jpeg_, TRUE);
  return true;
}

bool JpegDecoder::readPixels(J_COLOR_SPACE colors, std::uint8_t* pixels) {
  if (setjmp(failure_.jump) != 0) return false;
  jpeg_.out_color_space = colors;
  jpeg_start_decompress(&jpeg_);
  readRows(pixels);
  jpeg_finish_decompress(&jpeg_);
  return true;
}

void JpegDecoder::readRows(std::uint8_t* pixels) {
  const std::size_t rowBytes = jpeg_.output_width * static_cast<std::size_t>(jpeg_.output_components);
  while (jpeg_.output_scanline < jpeg_.output_height) {
    JSAMPROW row = pixels + jpeg_.output_scanline * rowBytes;
    jpeg_read_scanlines(&jpeg_, &row, 1);
  }
}

tl::unexpected<Error> JpegDecoder::failure(const std::string& where) const {
  if (failure_.msg_code == JERR_OUT_OF_MEMORY) return fail("there is not enough memory to read it", where);
  const std::string reason = failure_.message.data();
  if (!isUnsupported(failure_.msg_code)) return fail("the JPEG is damaged: " + reason, where);
  return fail("this kind of JPEG is not supported: " + reason, where, "save it as an ordinary JPEG or a PNG");
}

/// At least a bit for a block of 8 x 8 pixels in a scan: of its mean, and, where it is not in
/// another scan, of its end.
bool fitsIntoFile(const jpeg_decompress_struct& jpeg, std::size_t fileBytes) {
  std::uint64_t blocks = 0, samples = 0;
  for (int i = 0; i < jpeg.num_components; ++i) {
    blocks += std::uint64_t{jpeg.comp_info[i].width_in_blocks} * jpeg.comp_info[i].height_in_blocks;
    samples += std::uint64_t{jpeg.image_width} * jpeg.image_height;
  }
  // Arithmetic coding has no least number of bits; larger pictures coded so are measured by
  // Huffman's.
  if (jpeg.arith_code && samples <= kFreeBytes) return true;
  return blocks * (jpeg.progressive_mode || jpeg.arith_code ? 1 : 2) <= std::uint64_t{fileBytes} * 8;
}

Result<int> channelsOf(const jpeg_decompress_struct& jpeg, const std::string& where) {
  switch (jpeg.jpeg_color_space) {
    case JCS_GRAYSCALE:
      return 1;
    case JCS_YCbCr:
    case JCS_RGB:
      return 3;
    case JCS_CMYK:
    case JCS_YCCK:
      return fail("the JPEG is CMYK, made for printing", where, "convert it to RGB");
    default:
      return fail(fmt::format("a JPEG of {} components is not supported", jpeg.num_components), where);
  }
}

Orientation orientationOf(const jpeg_decompress_struct& jpeg) {
  constexpr std::array<std::uint8_t, 6> kExif{'E', 'x', 'i', 'f', 0, 0};
  for (const jpeg_marker_struct* marker = jpeg.marker_list; marker; marker = marker->next) {
    const Bytes data(marker->data, marker->data_length);
    if (data.size() > kExif.size() && std::ranges::equal(data.first(kExif.size()), kExif))
      return exifOrientation(data.subspan(kExif.size()));
  }
  return Orientation::Upright;
}

Result<ImageHeader> checkedHeader(JpegDecoder& decoder, Bytes bytes, const std::string& where) {
  if (!decoder.readHeader(bytes)) return decoder.failure(where);
  const jpeg_decompress_struct& jpeg = decoder.header();
  WEFT_TRY_VOID(checkImageSize(jpeg.image_width, jpeg.image_height, where));
  ImageHeader header{static_cast<int>(jpeg.image_width), static_cast<int>(jpeg.image_height)};
  WEFT_TRY(header.channels, channelsOf(jpeg, where));
  if (!fitsIntoFile(jpeg, bytes.size()))
    return imageBeyondFile(header.width, header.height, bytes.size(), where);
  header.orientation = orientationOf(jpeg);
  return header;
}

struct DestroyTurboJpeg {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using TurboJpeg = std::unique_ptr<void, DestroyTurboJpeg>;

}  // namespace

bool isJpeg(Bytes bytes) {
  return bytes.size() > 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

Result<ImageHeader> readJpegHeader(Bytes bytes, const std::string& where) {
  JpegDecoder decoder;
  return checkedHeader(decoder, bytes, where);
}

Result<void> decodeJpeg(Bytes bytes, int channels, std::span<std::uint8_t> pixels, const std::string& where) {
  JpegDecoder decoder;
  WEFT_TRY(const ImageHeader header, checkedHeader(decoder, bytes, where));
  WEFT_EXPECT(pixels.size() == static_cast<std::size_t>(header.width) *
                                   static_cast<std::size_t>(header.height) *
                                   static_cast<std::size_t>(channels),
              "pixels hold the image");
  if (!decoder.readPixels(channels == 1 ? JCS_GRAYSCALE : JCS_RGB, pixels.data()))
    return decoder.failure(where);
  return {};
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

}  // namespace weft
