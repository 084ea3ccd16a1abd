#include "weft/io/ExrFile.h"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "TestImages.h"
#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

FloatImage madeUpImage() {
  FloatImage image(11, 35, {"R", "G", "B", "lobe0.x"});
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = std::sin(static_cast<float>(i)) * static_cast<float>(i);
  return image;
}

// The same whatever the order of the channels.
void expectSameByName(const FloatImage& actual, const FloatImage& expected) {
  ASSERT_EQ(actual.width(), expected.width());
  ASSERT_EQ(actual.height(), expected.height());
  ASSERT_EQ(actual.channelCount(), expected.channelCount());
  for (int c = 0; c < expected.channelCount(); ++c) {
    const auto index = actual.channelIndex(expected.channels()[static_cast<std::size_t>(c)]);
    ASSERT_TRUE(index);
    for (int y = 0; y < expected.height(); ++y)
      for (int x = 0; x < expected.width(); ++x)
        ASSERT_EQ(actual.at(x, y, *index), expected.at(x, y, c)) << x << ' ' << y << ' ' << c;
  }
}

std::string errorOfExr(const fs::path& file) {
  const auto image = readExr(file);
  return image ? "read" : image.error().message();
}

TEST(ExrFile, KeepsFloatsExactly) {
  const fs::path folder = test::testFolder();
  FloatImage image = madeUpImage();
  image.at(3, 4, 1) = INFINITY;
  image.at(3, 5, 1) = 1e-42f;
  image.metadata["weft.note"] = "what is this";
  requireDone(writeExr(folder / "a.exr", image));
  const FloatImage read = valueOf(readExr(folder / "a.exr"));
  expectSameByName(read, image);
  EXPECT_EQ(read.precision(), Precision::Float);
  EXPECT_EQ(read.metadata, image.metadata);
  EXPECT_EQ(read.channels(), (std::vector<std::string>{"B", "G", "R", "lobe0.x"}));
  EXPECT_THAT(test::namesIn(folder), testing::ElementsAre("a.exr"));
}

TEST(ExrFile, KeepsHalfsExactly) {
  const fs::path file = test::testFolder() / "a.exr";
  FloatImage image = madeUpImage();
  image.roundToHalf();
  requireDone(writeExr(file, image));
  const FloatImage read = valueOf(readExr(file));
  expectSameByName(read, image);
  EXPECT_EQ(read.precision(), Precision::Half);
  const Imf::InputFile independent(file.c_str());
  EXPECT_EQ(independent.header().channels().findChannel("G")->type, Imf::HALF);
}

TEST(ExrFile, WritesWhatOpenExrReads) {
  const fs::path file = test::testFolder() / "a.exr";
  const FloatImage image = madeUpImage();
  requireDone(writeExr(file, image));
  Imf::InputFile independent(file.c_str());
  std::vector<float> blue(11 * 35);
  Imf::FrameBuffer buffer;
  buffer.insert("B", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(blue.data()), 4, 11 * 4));
  independent.setFrameBuffer(buffer);
  independent.readPixels(0, 34);
  for (int y = 0; y < 35; ++y)
    for (int x = 0; x < 11; ++x) ASSERT_EQ(blue[static_cast<std::size_t>(y * 11 + x)], image.at(x, y, 2));
}

TEST(ExrFile, ReadsADataWindowThatDoesNotStartAtZero) {
  const fs::path file = test::testFolder() / "window.exr";
  const Imath::Box2i window({-3, 5}, {1, 7});
  Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), window);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  std::vector<float> values(5 * 3);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
  Imf::FrameBuffer buffer;
  buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  {
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(3);
  }
  const FloatImage image = valueOf(readExr(file));
  ASSERT_EQ(image.width(), 5);
  ASSERT_EQ(image.height(), 3);
  EXPECT_TRUE(std::equal(values.begin(), values.end(), image.values().begin()));
}

TEST(ExrFile, ReadsTilesAndMixedPrecision) {
  const fs::path file = test::testFolder() / "tiles.exr";
  Imf::Header header(20, 18);
  header.channels().insert("F", Imf::Channel(Imf::FLOAT));
  header.channels().insert("H", Imf::Channel(Imf::HALF));
  header.setTileDescription(Imf::TileDescription(8, 8));
  std::vector<float> floats(20 * 18);
  std::vector<half> halfs(20 * 18);
  for (std::size_t i = 0; i < floats.size(); ++i) {
    floats[i] = 0.1f * static_cast<float>(i);
    halfs[i] = half(static_cast<float>(i));
  }
  Imf::FrameBuffer buffer;
  buffer.insert("F", Imf::Slice::Make(Imf::FLOAT, floats.data(), header.dataWindow()));
  buffer.insert("H", Imf::Slice::Make(Imf::HALF, halfs.data(), header.dataWindow()));
  {
    Imf::TiledOutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writeTiles(0, output.numXTiles() - 1, 0, output.numYTiles() - 1);
  }
  const FloatImage image = valueOf(readExr(file));
  EXPECT_EQ(image.precision(), Precision::Float);
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 20; ++x) {
      ASSERT_EQ(image.at(x, y, 0), 0.1f * static_cast<float>(y * 20 + x));
      ASSERT_EQ(image.at(x, y, 1), static_cast<float>(y * 20 + x));
    }
}

TEST(ExrFile, RefusesIntegerChannels) {
  const fs::path file = test::testFolder() / "id.exr";
  Imf::Header header(4, 4);
  header.channels().insert("id", Imf::Channel(Imf::UINT));
  std::vector<std::uint32_t> values(16);
  Imf::FrameBuffer buffer;
  buffer.insert("id", Imf::Slice::Make(Imf::UINT, values.data(), header.dataWindow()));
  {
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(4);
  }
  EXPECT_THAT(errorOfExr(file), HasSubstr("channel 'id' is integer or subsampled"));
}

TEST(ExrFile, RefusesMissingAndForeignFiles) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(errorOfExr(folder / "none.exr"), HasSubstr("none.exr: no such file"));
  test::writeBytes(folder / "text.exr", {'h', 'e', 'l', 'l', 'o'});
  EXPECT_THAT(errorOfExr(folder / "text.exr"), HasSubstr("text.exr: this is a text, not an OpenEXR file"));
  EXPECT_NE(errorOfExr(folder), "read");
}

TEST(ExrFile, RefusesEveryTruncation) {
  const fs::path file = test::testFolder() / "a.exr";
  requireDone(writeExr(file, madeUpImage()));
  const test::Bytes whole = test::bytesOf(file);
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    test::writeBytes(file, test::Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    ASSERT_THAT(errorOfExr(file), HasSubstr("a.exr: ")) << size;
  }
}

// OpenEXR would take two gigabytes for the attribute before it finds that they are not there.
TEST(ExrFile, RefusesAnAttributeLargerThanTheFile) {
  const fs::path file = test::testFolder() / "a.exr";
  FloatImage image = madeUpImage();
  image.metadata["weft.note"] = "what is this";
  requireDone(writeExr(file, image));
  test::Bytes bytes = test::bytesOf(file);
  const char tag[] = "weft.note\0string";
  const auto at = std::search(bytes.begin(), bytes.end(), tag, tag + sizeof(tag));
  ASSERT_NE(at, bytes.end());
  std::copy_n("\xff\xff\xff\x7f", 4, at + sizeof(tag));
  test::writeBytes(file, bytes);
  EXPECT_THAT(errorOfExr(file), HasSubstr("the OpenEXR header is damaged"));
}

TEST(ExrFile, RefusesPixelsThatTheFileCannotHold) {
  const fs::path file = test::testFolder() / "a.exr";
  requireDone(writeExr(file, madeUpImage()));
  test::Bytes bytes = test::bytesOf(file);
  const char tag[] = "dataWindow\0box2i";
  const auto at = std::search(bytes.begin(), bytes.end(), tag, tag + sizeof(tag));
  ASSERT_NE(at, bytes.end());
  const auto setMaximum = [&](int x, int y) {
    const int maximum[2] = {x, y};
    std::memcpy(&*(at + sizeof(tag) + 4 + 8), maximum, sizeof(maximum));
    test::writeBytes(file, bytes);
  };
  setMaximum(16383, 16383);
  EXPECT_NE(errorOfExr(file), "read");
  setMaximum(99999, 34);
  EXPECT_NE(errorOfExr(file), "read");
  setMaximum(16383, 3000);
  EXPECT_NE(errorOfExr(file), "read");
}

TEST(ExrFile, SurvivesMutations) {
  const fs::path file = test::testFolder() / "a.exr";
  FloatImage image = madeUpImage();
  image.roundToHalf();
  requireDone(writeExr(file, image));
  const test::Bytes whole = test::bytesOf(file);
  unsigned random = 7;
  for (int i = 0; i < 400; ++i) {
    test::Bytes bytes = whole;
    for (int k = 0; k < 2; ++k) {
      random = random * 1664525u + 1013904223u;
      bytes[(random >> 8) % (i % 2 ? std::size_t{400} : bytes.size())] = static_cast<std::uint8_t>(random);
    }
    test::writeBytes(file, bytes);
    const auto read = readExr(file);  // either is fine, without harm
    EXPECT_TRUE(!read || !read->empty());
  }
}

}  // namespace
}  // namespace weft
