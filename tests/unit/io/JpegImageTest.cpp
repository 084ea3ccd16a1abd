#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "TestImages.h"
#include "TestSupport.h"
#include "weft/io/ImageFile.h"

// Needs <cstdio> before it.
#include <jpeglib.h>

namespace weft {
namespace {

using test::Bytes;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

/// A JPEG as libjpeg writes it.
struct TestJpeg {
  int width = 16;
  int height = 8;
  J_COLOR_SPACE pixels = JCS_RGB;
  J_COLOR_SPACE stored = JCS_YCbCr;
  bool progressive = false;
  bool arithmetic = false;
  Bytes exif{};  ///< after "Exif"
  std::function<int(int x, int y, int channel)> value = [](int, int, int) { return 128; };
};

int channelsOf(J_COLOR_SPACE space) {
  return space == JCS_GRAYSCALE ? 1 : space == JCS_CMYK || space == JCS_YCCK ? 4 : 3;
}

void writeRows(jpeg_compress_struct& jpeg, const TestJpeg& image) {
  for (int y = 0; y < image.height; ++y) {
    Bytes row;
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channelsOf(image.pixels); ++c)
        row.push_back(static_cast<std::uint8_t>(image.value(x, y, c)));
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
}

Bytes bytesOf(const TestJpeg& image) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &buffer, &size);
  jpeg.image_width = static_cast<JDIMENSION>(image.width);
  jpeg.image_height = static_cast<JDIMENSION>(image.height);
  jpeg.input_components = channelsOf(image.pixels);
  jpeg.in_color_space = image.pixels;
  jpeg_set_defaults(&jpeg);
  jpeg_set_colorspace(&jpeg, image.stored);
  jpeg.comp_info[0].h_samp_factor = jpeg.comp_info[0].v_samp_factor = 1;
  jpeg.optimize_coding = !image.arithmetic;
  jpeg.arith_code = image.arithmetic;
  if (image.progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  if (!image.exif.empty()) {
    Bytes marker{'E', 'x', 'i', 'f', 0, 0};
    marker.insert(marker.end(), image.exif.begin(), image.exif.end());
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, marker.data(), static_cast<unsigned>(marker.size()));
  }
  writeRows(jpeg, image);
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  const Bytes bytes(buffer, buffer + size);
  std::free(buffer);
  return bytes;
}

std::string errorOfJpeg(const Bytes& bytes) {
  const auto image = decodeImage(bytes, "a.jpg");
  return image ? "decoded" : image.error().message();
}

TEST(JpegImage, GreyAndRgbOfAllCodings) {
  for (const bool progressive : {false, true})
    for (const bool arithmetic : {false, true}) {
      const Image grey = valueOf(decodeImage(bytesOf({.pixels = JCS_GRAYSCALE,
                                                      .stored = JCS_GRAYSCALE,
                                                      .progressive = progressive,
                                                      .arithmetic = arithmetic}),
                                             "grey"));
      EXPECT_EQ(grey.channels, 1);
      EXPECT_EQ(grey.bytes, Bytes(16 * 8, 128));
      const Image rgb =
          valueOf(decodeImage(bytesOf({.progressive = progressive, .arithmetic = arithmetic}), "rgb"));
      EXPECT_EQ(rgb.channels, 3);
      EXPECT_EQ(rgb.bytes, Bytes(16 * 8 * 3, 128));
    }
}

TEST(JpegImage, WhatIsNotReadIsNamed) {
  for (const J_COLOR_SPACE stored : {JCS_CMYK, JCS_YCCK}) {
    const std::string message = errorOfJpeg(bytesOf({.pixels = JCS_CMYK, .stored = stored}));
    EXPECT_THAT(message, HasSubstr("a.jpg: the JPEG is CMYK, made for printing (convert it to RGB)"));
  }
  Bytes bytes = bytesOf({});
  const auto frame = std::search(bytes.begin(), bytes.end(), "\xff\xc0", "\xff\xc0" + 2,
                                 [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
  ASSERT_NE(frame, bytes.end());
  frame[4] = 12;
  EXPECT_THAT(errorOfJpeg(bytes),
              HasSubstr("this kind of JPEG is not supported: Unsupported JPEG data precision 12"));
  frame[1] = 0xc3;
  EXPECT_THAT(errorOfJpeg(bytes), HasSubstr("this kind of JPEG is not supported"));
}

TEST(JpegImage, OtherFilesAreNamed) {
  EXPECT_THAT(errorOfJpeg({'G', 'I', 'F', '8', '9', 'a'}),
              HasSubstr("a.jpg: this is an image of another format, not a JPEG or PNG image"));
  EXPECT_THAT(errorOfJpeg({}), HasSubstr("a.jpg: this is an empty file, not a JPEG or PNG image"));
  EXPECT_THAT(errorOfJpeg({0x1b, '['}), HasSubstr("a.jpg: this is not a JPEG or PNG image"));
}

// Cameras leave bytes before the end; before other markers they are pixels that are lost.
TEST(JpegImage, BytesBeforeTheEndAreHarmless) {
  Bytes bytes = bytesOf({});
  bytes.insert(bytes.end() - 2, {1, 2, 3});
  EXPECT_EQ(errorOfJpeg(bytes), "decoded");
}

/// TIFF with one directory, which holds the orientation.
Bytes exifOf(int orientation, bool bigEndian = false) {
  if (bigEndian)
    return {'M', 'M',  0, 42, 0, 0, 0, 8, 0, 1,
            1,   0x12, 0, 3,  0, 0, 0, 1, 0, static_cast<std::uint8_t>(orientation),
            0,   0,    0, 0,  0, 0};
  return {
      'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 1, 3, 0, 1, 0, 0, 0, static_cast<std::uint8_t>(orientation),
      0,   0,   0,  0, 0, 0, 0};
}

/// 16 x 8, grey: its corners, from the upper left along the rows, are 0, 80, 160, 240.
TestJpeg corners(const Bytes& exif) {
  return {.pixels = JCS_GRAYSCALE, .stored = JCS_GRAYSCALE, .exif = exif, .value = [](int x, int y, int) {
            return (x >= 8 ? 80 : 0) + (y >= 4 ? 160 : 0);
          }};
}

std::vector<int> cornersOf(const Bytes& bytes) {
  const ImageSize size = valueOf(photographHeader(bytes, "photograph")).size;
  Bytes rgb(static_cast<std::size_t>(3 * size.width * size.height));
  requireDone(decodePhotograph(bytes, size, std::span(rgb), "photograph"));
  std::vector<int> values{size.width};
  for (const int y : {0, size.height - 1})
    for (const int x : {0, size.width - 1})
      values.push_back((rgb[static_cast<std::size_t>(3 * (y * size.width + x))] + 40) / 80);
  return values;
}

TEST(JpegImage, PhotographsStandUpright) {
  // Where the stored corners 0 1 / 2 3 come to lie, after the width.
  const std::vector<std::vector<int>> expected{{16, 0, 1, 2, 3}, {16, 1, 0, 3, 2}, {16, 3, 2, 1, 0},
                                               {16, 2, 3, 0, 1}, {8, 0, 2, 1, 3},  {8, 2, 0, 3, 1},
                                               {8, 3, 1, 2, 0},  {8, 1, 3, 0, 2}};
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const bool bigEndian : {false, true})
      EXPECT_EQ(cornersOf(bytesOf(corners(exifOf(orientation, bigEndian)))),
                expected[static_cast<std::size_t>(orientation - 1)])
          << orientation;
  for (const int none : {0, 9, 255}) EXPECT_EQ(cornersOf(bytesOf(corners(exifOf(none)))), expected[0]);
  EXPECT_EQ(cornersOf(bytesOf(corners({}))), expected[0]);
}

TEST(JpegImage, TexturesLieAsStored) {
  const Image image = valueOf(decodeImage(bytesOf(corners(exifOf(6))), "texture"));
  EXPECT_EQ(image.width, 16);
  EXPECT_LT(*image.pixel(0, 0), 10);
}

TEST(JpegImage, DamagedExifTurnsNothing) {
  const Bytes whole = exifOf(6);
  for (std::size_t size = 0; size < 20; ++size)
    EXPECT_EQ(cornersOf(bytesOf(
                  corners(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)))))[0],
              16)
        << size;
  unsigned random = 3;
  for (int i = 0; i < 300; ++i) {
    Bytes exif = whole;
    for (int k = 0; k < 3; ++k) {
      random = random * 1664525u + 1013904223u;
      exif[(random >> 8) % exif.size()] = static_cast<std::uint8_t>(random);
    }
    EXPECT_EQ(cornersOf(bytesOf(corners(exif))).size(), 5u);
  }
}

// Every block of 8 x 8 pixels takes a bit or two, but in arithmetic coding.
TEST(JpegImage, EmptyPicturesAreWellPacked) {
  for (const bool progressive : {false, true})
    for (const bool arithmetic : {false, true}) {
      const Bytes bytes =
          bytesOf({.width = 2000, .height = 1000, .progressive = progressive, .arithmetic = arithmetic});
      EXPECT_EQ(errorOfJpeg(bytes), "decoded") << bytes.size();
    }
}

TEST(JpegImage, ClaimsAreProvedBeforeMemoryIsTaken) {
  for (const bool progressive : {false, true})
    for (const bool arithmetic : {false, true}) {
      Bytes bytes = bytesOf({.progressive = progressive, .arithmetic = arithmetic});
      for (std::size_t i = 0; i + 9 < bytes.size(); ++i)
        if (bytes[i] == 0xff && (bytes[i + 1] & 0xf4) == 0xc0 && bytes[i + 1] != 0xc4) {
          const std::array<std::uint8_t, 4> size{0x10, 0, 0x40, 0};  // 16384 x 4096
          std::ranges::copy(size, bytes.begin() + static_cast<std::ptrdiff_t>(i) + 5);
          break;
        }
      bytes.resize(67000);
      const std::uint64_t before = test::peakMemory();
      EXPECT_THAT(errorOfJpeg(bytes),
                  HasSubstr("a.jpg: an image of 16384 x 4096 pixels cannot be in 67000 bytes"));
      EXPECT_LT(test::peakMemory() - before, std::uint64_t{60} << 20);
    }
}

}  // namespace
}  // namespace weft
