#include "weft/io/ImageFile.h"

#include <gmock/gmock.h>

#include "TestImages.h"
#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

std::string errorOf(const test::Bytes& bytes) {
  const auto image = decodeImage(bytes, "test");
  return image ? "decoded" : image.error().message();
}

Image gradient(int channels) {
  Image image(7, 5, channels);
  for (std::size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = static_cast<std::uint8_t>(i * 37);
  return image;
}

TEST(ImageFile, PngKeepsEveryByteOfOneToFourChannels) {
  const fs::path file = test::testFolder() / "a.png";
  for (int channels = 1; channels <= 4; ++channels) {
    requireDone(writePng(file, gradient(channels)));
    const Image image = valueOf(readImage(file));
    EXPECT_EQ(valueOf(decodeImage(valueOf(encodePng(gradient(channels))), "png")).bytes, image.bytes);
    EXPECT_EQ(image.width, 7);
    EXPECT_EQ(image.height, 5);
    EXPECT_EQ(image.channels, channels);
    EXPECT_EQ(image.bytes, gradient(channels).bytes);
  }
}

TEST(ImageFile, JpegKeepsSizeAndAlmostTheColours) {
  const Image flat =
      test::imageOf(20, 10, [](int x, int, int c) { return x < 8 ? 200 - 60 * c : 40 + 50 * c; });
  const test::Bytes bytes = valueOf(encodeJpeg(flat, 95));
  const ImageSize size = valueOf(photographHeader(bytes, "test")).size;
  EXPECT_EQ(size.width, 20);
  EXPECT_EQ(size.height, 10);
  const Image image = valueOf(decodeImage(bytes, "test"));
  ASSERT_EQ(image.bytes.size(), flat.bytes.size());
  for (std::size_t i = 0; i < flat.bytes.size(); ++i) ASSERT_NEAR(image.bytes[i], flat.bytes[i], 3);
}

TEST(ImageFile, WritesLinearImagesAsSrgb) {
  const fs::path file = test::testFolder() / "linear.png";
  FloatImage linear(7, 1, {"A", "B", "G", "R"});
  const std::vector<float> values{0.0f, 0.5f, 1.0f, 2.0f, -1.0f, std::nanf(""), INFINITY};
  for (int x = 0; x < 7; ++x) {
    linear.at(x, 0, 3) = values[static_cast<std::size_t>(x)];
    linear.at(x, 0, 1) = 0.25f;
  }
  requireDone(writePng(file, linear));
  const Image image = valueOf(readImage(file));
  ASSERT_EQ(image.channels, 3);
  // 0.5 is 188 by the standard's curve
  const std::vector<int> expectedRed{0, 188, 255, 255, 0, 0, 255};
  for (int x = 0; x < 7; ++x) {
    EXPECT_EQ(image.pixel(x, 0)[0], expectedRed[static_cast<std::size_t>(x)]) << x;
    EXPECT_EQ(image.pixel(x, 0)[1], 0);
    EXPECT_EQ(image.pixel(x, 0)[2], 137);
  }
}

TEST(ImageFile, RefusesALinearImageWithoutRgb) {
  const fs::path folder = test::testFolder();
  const Result<void> result = writePng(folder / "y.png", FloatImage(2, 2, {"Y"}));
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message(), HasSubstr("no channels R, G, B"));
  EXPECT_THAT(test::namesIn(folder), testing::IsEmpty());
}

TEST(ImageFile, RefusesMissingFilesAndFolders) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(readImage(folder / "none.png").error().message(), HasSubstr("none.png: no such file"));
  EXPECT_THAT(readImage(folder).error().message(), HasSubstr("cannot be read"));
}

TEST(ImageFile, RefusesEveryTruncation) {
  const fs::path file = test::testFolder() / "a.png";
  requireDone(writePng(file, gradient(3)));
  const test::Bytes png = test::bytesOf(file);
  const test::Bytes jpeg = valueOf(encodeJpeg(gradient(3), 95));
  for (const test::Bytes& whole : {png, jpeg})
    // The PNG's last chunk holds nothing.
    for (std::size_t size = 0; size + 12 < whole.size(); ++size)
      ASSERT_NE(errorOf(test::Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
                "decoded")
          << size;
}

TEST(ImageFile, SurvivesMutations) {
  const fs::path file = test::testFolder() / "a.png";
  requireDone(writePng(file, gradient(4)));
  unsigned random = 1;
  for (const test::Bytes& whole : {test::bytesOf(file), valueOf(encodeJpeg(gradient(3), 95))})
    for (int i = 0; i < 500; ++i) {
      test::Bytes bytes = whole;
      for (int k = 0; k < 3; ++k) {
        random = random * 1664525u + 1013904223u;
        bytes[(random >> 8) % bytes.size()] = static_cast<std::uint8_t>(random);
      }
      const auto image = decodeImage(bytes, "test");  // either is fine, without harm
      EXPECT_TRUE(!image || !image->bytes.empty());
    }
}

// A header is all it takes to claim a size; both are refused before memory is taken for it.
TEST(ImageFile, RefusesHugeSizes) {
  test::Bytes jpeg = valueOf(encodeJpeg(gradient(3), 95));
  for (std::size_t i = 0; i + 8 < jpeg.size(); ++i)
    if (jpeg[i] == 0xff && jpeg[i + 1] == 0xc0)
      std::fill_n(jpeg.begin() + static_cast<std::ptrdiff_t>(i) + 5, 4, 0x7f);
  EXPECT_THAT(errorOf(jpeg), HasSubstr("32639 x 32639 pixels is not supported"));

  // 60000 x 60000, with the checksum that belongs to it.
  const test::Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0,    0, 0,    13,
                        'I',  'H', 'D', 'R', 0,    0,    0xea, 0x60, 0,    0, 0xea, 0x60,
                        8,    2,   0,   0,   0,    0x0f, 0xb0, 0xe2, 0x15, 0, 0,    0,
                        0,    'I', 'D', 'A', 'T',  0x35, 0xaf, 0x06, 0x1e};
  EXPECT_THAT(errorOf(png), HasSubstr("60000 x 60000 pixels is not supported"));
}

}  // namespace
}  // namespace weft
