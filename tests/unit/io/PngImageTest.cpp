#include <gmock/gmock.h>
#include <png.h>

#include <functional>

#include "TestImages.h"
#include "TestSupport.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

using test::Bytes;
using test::valueOf;
using testing::HasSubstr;

/// A PNG as libpng's row interface writes it.
struct TestPng {
  int width = 0;
  int height = 1;
  int depth = 8;
  int color = PNG_COLOR_TYPE_RGB;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<Bytes> rows{};                                   ///< packed, big-endian
  std::function<void(png_structp, png_infop)> more = nullptr;  ///< further chunks before the pixels
};

Bytes bytesOf(TestPng image) {
  Bytes bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, std::size_t count) {
        auto* out = static_cast<Bytes*>(png_get_io_ptr(writer));
        out->insert(out->end(), data, data + count);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
               image.depth, image.color, image.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (image.more) image.more(png, info);
  png_write_info(png, info);
  std::vector<png_bytep> rows;
  for (Bytes& row : image.rows) rows.push_back(row.data());
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

const std::vector<png_color> kPalette{{10, 20, 30}, {40, 50, 60}, {70, 80, 90}, {100, 110, 120}};

void addPalette(png_structp png, png_infop info) {
  png_set_PLTE(png, info, kPalette.data(), static_cast<int>(kPalette.size()));
}

Bytes pixelsOf(const TestPng& image) {
  return valueOf(decodeImage(bytesOf(image), "test")).bytes;
}

// What a file says of colour does not change a byte; what the bytes mean, the use says.
TEST(PngImage, ColourChunksChangeNothing) {
  const std::vector<std::function<void(png_structp, png_infop)>> chunks{
      [](png_structp png, png_infop info) { png_set_gAMA(png, info, 1.0); },
      [](png_structp png, png_infop info) { png_set_gAMA(png, info, 0.45455); },
      [](png_structp png, png_infop info) { png_set_sRGB(png, info, PNG_sRGB_INTENT_ABSOLUTE); },
      [](png_structp png, png_infop info) { png_set_cHRM(png, info, .31, .33, .7, .3, .2, .7, .1, .05); },
      [](png_structp png, png_infop info) {
        const png_color_8 bits{5, 5, 5, 5, 0};
        png_set_sBIT(png, info, &bits);
      }};
  for (const auto& chunk : chunks) {
    EXPECT_EQ(pixelsOf({.width = 1, .rows = {{100, 150, 200}}, .more = chunk}), (Bytes{100, 150, 200}));
    const Bytes wide = bytesOf({.width = 1, .depth = 16, .rows = {{1, 2, 3, 4, 5, 6}}, .more = chunk});
    EXPECT_EQ(valueOf(decodeWideImage(wide, "test")).words,
              (std::vector<std::uint16_t>{0x102, 0x304, 0x506}));
  }
}

TEST(PngImage, PalettesAndFewBits) {
  EXPECT_EQ(pixelsOf({.width = 3,
                      .depth = 2,
                      .color = PNG_COLOR_TYPE_PALETTE,
                      .rows = {{0b11000100}},
                      .more = addPalette}),
            (Bytes{100, 110, 120, 10, 20, 30, 40, 50, 60}));
  EXPECT_EQ(pixelsOf({.width = 5, .depth = 1, .color = PNG_COLOR_TYPE_GRAY, .rows = {{0b10110000}}}),
            (Bytes{255, 0, 255, 255, 0}));
  EXPECT_EQ(pixelsOf({.width = 2, .depth = 2, .color = PNG_COLOR_TYPE_GRAY, .rows = {{0b01100000}}}),
            (Bytes{85, 170}));
  EXPECT_EQ(pixelsOf({.width = 3, .depth = 4, .color = PNG_COLOR_TYPE_GRAY, .rows = {{0x1f, 0x80}}}),
            (Bytes{17, 255, 136}));
}

TEST(PngImage, TransparencyBecomesAlpha) {
  const auto transparentPalette = [](png_structp png, png_infop info) {
    addPalette(png, info);
    const Bytes alpha{0, 128};
    png_set_tRNS(png, info, alpha.data(), 2, nullptr);
  };
  EXPECT_EQ(pixelsOf({.width = 3,
                      .depth = 8,
                      .color = PNG_COLOR_TYPE_PALETTE,
                      .rows = {{0, 1, 2}},
                      .more = transparentPalette}),
            (Bytes{10, 20, 30, 0, 40, 50, 60, 128, 70, 80, 90, 255}));
  const auto transparentColor = [](png_structp png, png_infop info) {
    png_color_16 color{};
    color.gray = color.red = color.green = color.blue = 7;
    png_set_tRNS(png, info, nullptr, 0, &color);
  };
  EXPECT_EQ(pixelsOf({.width = 2, .color = PNG_COLOR_TYPE_GRAY, .rows = {{7, 8}}, .more = transparentColor}),
            (Bytes{7, 0, 8, 255}));
  EXPECT_EQ(pixelsOf({.width = 2, .rows = {{7, 7, 7, 8, 7, 7}}, .more = transparentColor}),
            (Bytes{7, 7, 7, 0, 8, 7, 7, 255}));
  // In 16 bits the colour is 7 and not 7 * 257.
  const Bytes wide = bytesOf({.width = 2,
                              .depth = 16,
                              .color = PNG_COLOR_TYPE_GRAY,
                              .rows = {{0, 7, 7, 7}},
                              .more = transparentColor});
  EXPECT_EQ(valueOf(decodeWideImage(wide, "test")).words, (std::vector<std::uint16_t>{7, 0, 0x707, 65535}));
  EXPECT_EQ(valueOf(decodeImage(wide, "test")).bytes, (Bytes{0, 0, 7, 255}));
}

TEST(PngImage, SixteenBits) {
  const TestPng image{.width = 3,
                      .depth = 16,
                      .color = PNG_COLOR_TYPE_GRAY_ALPHA,
                      .rows = {{0, 0, 255, 255, 0x80, 0x80, 0, 127, 0x80, 0xff, 0, 129}}};
  const Bytes bytes = bytesOf(image);
  EXPECT_TRUE(isWideImage(bytes));
  EXPECT_EQ(valueOf(decodeWideImage(bytes, "test")).words,
            (std::vector<std::uint16_t>{0, 65535, 0x8080, 127, 0x80ff, 129}));
  // To the nearest eighth bit.
  EXPECT_EQ(valueOf(decodeImage(bytes, "test")).bytes, (Bytes{0, 255, 0x80, 0, 0x80, 1}));
  const Bytes narrow = bytesOf({.width = 1, .rows = {{0, 1, 255}}});
  EXPECT_FALSE(isWideImage(narrow));
  EXPECT_FALSE(isWideImage(Bytes{'P'}));
  EXPECT_EQ(valueOf(decodeWideImage(narrow, "test")).words, (std::vector<std::uint16_t>{0, 257, 65535}));
}

TEST(PngImage, Interlaced) {
  TestPng image{.width = 7, .height = 9, .color = PNG_COLOR_TYPE_GRAY, .interlace = PNG_INTERLACE_ADAM7};
  Bytes expected;
  for (int y = 0; y < 9; ++y) {
    Bytes& row = image.rows.emplace_back();
    for (int x = 0; x < 7; ++x) row.push_back(static_cast<std::uint8_t>(16 * y + x));
    expected.insert(expected.end(), row.begin(), row.end());
  }
  EXPECT_EQ(pixelsOf(image), expected);
}

TEST(PngImage, PhotographsAreRgb) {
  const Bytes grey = bytesOf({.width = 2, .color = PNG_COLOR_TYPE_GRAY_ALPHA, .rows = {{5, 99, 6, 99}}});
  Bytes rgb(6);
  test::requireDone(decodePhotograph(grey, {2, 1}, std::span(rgb), "test"));
  EXPECT_EQ(rgb, (Bytes{5, 5, 5, 6, 6, 6}));
  std::vector<std::uint16_t> wide(6);
  test::requireDone(decodePhotograph(grey, {2, 1}, std::span(wide), "test"));
  EXPECT_EQ(wide[3], 6 * 257);
  EXPECT_THAT(decodePhotograph(grey, {1, 2}, std::span(rgb), "a.png").error().message(),
              HasSubstr("a.png: the image has 2 x 1 pixels, the others have 1 x 2"));
}

TEST(PngImage, EmptyPicturesAreWellPacked) {
  TestPng image{.width = 8000, .height = 4000, .depth = 1, .color = PNG_COLOR_TYPE_GRAY};
  image.rows.assign(4000, Bytes(1000));
  const Bytes bytes = bytesOf(image);
  EXPECT_LT(bytes.size(), 8000u);  // 4 MB
  EXPECT_EQ(valueOf(decodeImage(bytes, "test")).bytes.size(), 32000000u);
}

// A text beside the pixels does not prove them.
TEST(PngImage, ClaimsAreProvedBeforeMemoryIsTaken) {
  Bytes bytes =
      bytesOf({.width = 1, .rows = {{1, 2, 3}}, .more = [](png_structp png, png_infop info) {
                 std::string text(100000, 'x');
                 std::string key = "Comment";
                 const png_text comment{
                     PNG_TEXT_COMPRESSION_NONE, key.data(), text.data(), text.size(), 0, nullptr, nullptr};
                 png_set_text(png, info, &comment, 1);
               }});
  for (const std::size_t byte : {18u, 22u}) bytes[byte] = 0x1f;  // 7937 a side
  png_uint_32 crc = 0xffffffffu;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  png_save_uint_32(bytes.data() + 29, ~crc);
  const std::uint64_t before = test::peakMemory();
  EXPECT_THAT(decodeImage(bytes, "a.png").error().message(),
              HasSubstr("a.png: an image of 7937 x 7937 pixels cannot be in 100"));
  EXPECT_LT(test::peakMemory() - before, std::uint64_t{60} << 20);
}

// Palettes and bits become whole bytes, so that a file that deflate could pack takes 30000 times
// its memory.
TEST(PngImage, WellPackedPicturesAreProvedBeforeMemoryIsTaken) {
  TestPng image{.width = 8192,
                .height = 8192,
                .depth = 1,
                .color = PNG_COLOR_TYPE_PALETTE,
                .more = [](png_structp png, png_infop info) {
                  png_set_PLTE(png, info, kPalette.data(), 2);
                  const Bytes alpha{7};
                  png_set_tRNS(png, info, alpha.data(), 1, nullptr);
                }};
  image.rows.assign(8192, Bytes(1024));
  Bytes bytes = bytesOf(image);
  EXPECT_LT(bytes.size(), 20000u);
  EXPECT_EQ(valueOf(photographHeader(bytes, "a.png")).size.width, 8192);
  bytes[bytes.size() / 2] ^= 255;
  const std::uint64_t before = test::peakMemory();
  EXPECT_THAT(decodeImage(bytes, "a.png").error().message(), HasSubstr("a.png: the PNG is damaged"));
  EXPECT_LT(test::peakMemory() - before, std::uint64_t{60} << 20);
}

}  // namespace
}  // namespace weft
