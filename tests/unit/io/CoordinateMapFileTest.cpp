#include "weft/io/CoordinateMapFile.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "TestImages.h"
#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

std::string errorOf(const Result<CoordinateMap>& map) {
  return map ? "read" : map.error().message();
}

// More rows than are read at once; the last texel of the sample is there.
CoordinateMap someMap() {
  std::vector<glm::u16vec2> texels;
  for (int i = 0; i < 7 * 150; ++i) texels.emplace_back(299 - i % 300, (i * 7) % 20);
  return valueOf(CoordinateMap::create(7, 150, 300, 20, std::move(texels), "wool"));
}

// A file of our form that says of its sample and its one texel what it likes.
fs::path writtenFile(const fs::path& path, int sampleWidth, std::uint32_t x,
                     Imf::PixelType type = Imf::UINT) {
  Imf::Header header(1, 1);
  header.insert("weftSampleWidth", Imf::IntAttribute(sampleWidth));
  header.insert("weftSampleHeight", Imf::IntAttribute(4));
  std::uint32_t value = x;
  Imf::FrameBuffer buffer;
  for (const char* channel : {"X", "Y"}) {
    header.channels().insert(channel, Imf::Channel(type));
    buffer.insert(channel, Imf::Slice(type, reinterpret_cast<char*>(&value), 4, 4));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(1);
  return path;
}

TEST(CoordinateMap, RefusesWhatIsNone) {
  using Texels = std::vector<glm::u16vec2>;
  EXPECT_THAT(errorOf(CoordinateMap::create(0, 1, 4, 4, {})), HasSubstr("0 x 1"));
  EXPECT_THAT(errorOf(CoordinateMap::create(16385, 1, 4, 4, {})), HasSubstr("1 to 16384 a side"));
  EXPECT_THAT(errorOf(CoordinateMap::create(1, 1, 4, 0, Texels(1))), HasSubstr("sample of 4 x 0"));
  EXPECT_THAT(errorOf(CoordinateMap::create(2, 2, 4, 4, Texels(3))), HasSubstr("2 x 2 has 3 texels"));
  Texels texels(6);
  texels[4] = {1, 4};
  EXPECT_THAT(errorOf(CoordinateMap::create(3, 2, 8, 4, texels)),
              HasSubstr("texel 1, 1 of the coordinate map lies outside of its sample of 8 x 4"));
}

TEST(CoordinateMapFile, KeepsEveryTexel) {
  const fs::path file = test::testFolder() / "a.coords.exr";
  const CoordinateMap map = someMap();
  requireDone(writeCoordinateMap(file, map));
  const CoordinateMap read = valueOf(readCoordinateMap(file));
  EXPECT_EQ(read.width(), 7);
  EXPECT_EQ(read.height(), 150);
  EXPECT_EQ(read.sampleWidth(), 300);
  EXPECT_EQ(read.sampleHeight(), 20);
  EXPECT_EQ(read.sampleName(), "wool");
  EXPECT_TRUE(std::ranges::equal(read.texels(), map.texels()));
  EXPECT_EQ(read.at(2, 149), glm::ivec2(299 - 1045 % 300, 1045 * 7 % 20));
  EXPECT_TRUE(isCoordinateMap(file));
  EXPECT_FALSE(isCoordinateMap(file.parent_path()));
}

TEST(CoordinateMapFile, RefusesWhatIsNone) {
  const fs::path folder = test::testFolder();
  const auto errorIn = [](const fs::path& file) { return errorOf(readCoordinateMap(file)); };
  EXPECT_THAT(errorIn(folder / "none.coords.exr"), HasSubstr("none.coords.exr"));
  EXPECT_THAT(errorIn(writtenFile(folder / "outside.exr", 4, 0x10001)),
              testing::AllOf(HasSubstr("outside.exr"), HasSubstr("texel 0, 0 of the coordinate map")));
  EXPECT_THAT(errorIn(writtenFile(folder / "size.exr", -3, 0)), HasSubstr("sample of -3 x 4"));
  EXPECT_THAT(errorIn(writtenFile(folder / "float.exr", 4, 0, Imf::FLOAT)), HasSubstr("integer channels X"));
}

TEST(CoordinateMapFile, EveryTruncationIsAnError) {
  const fs::path file = test::testFolder() / "a.coords.exr";
  requireDone(writeCoordinateMap(file, someMap()));
  const test::Bytes bytes = test::bytesOf(file);
  for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 8) {
    test::writeBytes(file, test::Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length)));
    EXPECT_THAT(errorOf(readCoordinateMap(file)), HasSubstr("a.coords.exr")) << length;
  }
}

}  // namespace
}  // namespace weft
