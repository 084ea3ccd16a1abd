#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "TestImages.h"
#include "TestSupport.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/io/ExrFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::valueOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Imath::Box2i kWindow({0, 0}, {3, 1});  // 4 x 2

/// A part whose channels have a value each, more to the right and below: + x / 8 + y / 16.
struct TestPart {
  std::string name;
  std::vector<std::pair<std::string, float>> channels;
  Imath::Box2i data = kWindow;
  Imath::Box2i display = kWindow;
  Imf::PixelType type = Imf::FLOAT;
};

Imf::Header headerOf(const TestPart& part) {
  Imf::Header header(part.display, part.data);
  header.setName(part.name);
  header.setType(Imf::SCANLINEIMAGE);
  for (const auto& [name, value] : part.channels) header.channels().insert(name, Imf::Channel(part.type));
  return header;
}

void writePart(Imf::MultiPartOutputFile& file, int index, const TestPart& part) {
  const int width = part.data.max.x - part.data.min.x + 1, height = part.data.max.y - part.data.min.y + 1;
  std::vector<std::vector<float>> values;
  Imf::FrameBuffer buffer;
  for (const auto& [name, value] : part.channels) {
    std::vector<float>& plane = values.emplace_back();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        plane.push_back(value + 0.125f * static_cast<float>(x) + 0.0625f * static_cast<float>(y));
    buffer.insert(name, Imf::Slice::Make(part.type, plane.data(), part.data));
  }
  Imf::OutputPart output(file, index);
  output.setFrameBuffer(buffer);
  output.writePixels(height);
}

fs::path exrOf(
    const std::vector<TestPart>& parts,
    const std::function<void(Imf::Header&)>& change = [](Imf::Header&) {}) {
  const fs::path path = test::testFolder() / "a.exr";
  std::vector<Imf::Header> headers;
  for (const TestPart& part : parts) headers.push_back(headerOf(part));
  change(headers.front());
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t i = 0; i < parts.size(); ++i) writePart(file, static_cast<int>(i), parts[i]);
  return path;
}

std::vector<std::pair<std::string, float>> colors(const std::string& layer, float red) {
  return {{layer + "R", red}, {layer + "G", red + 10}, {layer + "B", red + 20}};
}

struct Picture {
  FloatImage image;
  std::vector<std::string> warnings;

  glm::vec3 at(int x, int y) const { return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)}; }
};

Picture pictureOf(const fs::path& file) {
  Picture picture;
  picture.image = valueOf(readExrPicture(file, picture.warnings));
  return picture;
}

std::string errorOfPicture(const fs::path& file) {
  std::vector<std::string> warnings;
  const auto image = readExrPicture(file, warnings);
  return image ? "read" : image.error().message();
}

TEST(ExrPicture, DepthIsNoPicture) {
  const Picture picture = pictureOf(exrOf({{"depth", {{"Z", 5}}}, {"rgb", colors("", 1)}}));
  EXPECT_EQ(picture.at(0, 0), glm::vec3(1, 11, 21));
  EXPECT_EQ(picture.at(3, 1), glm::vec3(1.4375f, 11.4375f, 21.4375f));
  EXPECT_THAT(picture.warnings, IsEmpty());
  EXPECT_THAT(errorOfPicture(exrOf({{"depth", {{"Z", 5}}}})), HasSubstr("a.exr: the file holds no picture"));
  EXPECT_THAT(errorOfPicture(exrOf({{"depth", colors("", 1)}})), HasSubstr("no picture"));
  EXPECT_THAT(errorOfPicture(exrOf({{"normals", {{"X", 1}, {"Y", 1}, {"Z", 1}}}})),
              HasSubstr("only X, Y, Z"));
}

TEST(ExrPicture, LayersOfRenderers) {
  auto channels = colors("ViewLayer.Combined.", 1);
  for (const char* other :
       {"ViewLayer.Depth.Z", "ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z",
        "ViewLayer.CryptoObject00.r", "ViewLayer.CryptoObject00.g", "ViewLayer.CryptoObject00.b"})
    channels.emplace_back(other, 5.0f);
  Picture picture = pictureOf(exrOf({{"", channels}}));
  EXPECT_EQ(picture.at(0, 0), glm::vec3(1, 11, 21));
  EXPECT_THAT(picture.warnings, IsEmpty());

  for (const auto& channel : colors("ViewLayer.DiffCol.", 3)) channels.push_back(channel);
  picture = pictureOf(exrOf({{"", channels}}));
  EXPECT_EQ(picture.at(0, 0), glm::vec3(1, 11, 21));
  EXPECT_THAT(picture.warnings,
              ElementsAre("'ViewLayer.Combined' is taken for the picture, and not ViewLayer.DiffCol"));

  EXPECT_EQ(pictureOf(exrOf({{"", {{"beauty.red", 1}, {"beauty.green", 2}, {"beauty.blue", 3}}}})).at(0, 0),
            glm::vec3(1, 2, 3));
}

TEST(ExrPicture, ThePictureWithoutALayersName) {
  auto channels = colors("", 1);
  for (const auto& channel : colors("albedo.", 3)) channels.push_back(channel);
  channels.emplace_back("A", 1.0f);
  const Picture picture = pictureOf(exrOf({{"", channels}}));
  EXPECT_EQ(picture.at(0, 0), glm::vec3(1, 11, 21));
  EXPECT_THAT(picture.warnings, IsEmpty());
}

TEST(ExrPicture, SeveralPicturesAreListed) {
  EXPECT_THAT(errorOfPicture(exrOf({{"left", colors("", 1)}, {"right", colors("", 2)}})),
              HasSubstr("a.exr: the file holds several pictures: left, right"));
  std::vector<TestPart> parts;
  for (int i = 0; i < 12; ++i) parts.push_back({"light" + std::to_string(i + 10), colors("", 1)});
  EXPECT_THAT(errorOfPicture(exrOf(parts)), HasSubstr("light16, light17 and 4 more"));
}

TEST(ExrPicture, NamesOfLayersArePrintable) {
  const std::string message = errorOfPicture(exrOf({{"\x1b[2J", colors("", 1)}, {"\xff", colors("", 2)}}));
  EXPECT_THAT(message, HasSubstr("\\x1b[2J, \\xff"));
}

TEST(ExrPicture, GreyIsOneChannel) {
  const Picture picture = pictureOf(exrOf({{"", {{"Y", 2}}}}));
  EXPECT_THAT(picture.image.channels(), ElementsAre("Y"));
  EXPECT_EQ(picture.image.at(3, 1, 0), 2.4375f);
}

TEST(ExrPicture, DataWindowsArePlaced) {
  // The upper half of 4 x 2, one column to the right.
  Picture picture = pictureOf(exrOf({{"", colors("", 1), Imath::Box2i({1, 0}, {3, 0})}}));
  ASSERT_EQ(picture.image.width(), 4);
  ASSERT_EQ(picture.image.height(), 2);
  EXPECT_EQ(picture.at(0, 0), glm::vec3(0));
  EXPECT_EQ(picture.at(1, 0), glm::vec3(1, 11, 21));
  EXPECT_EQ(picture.at(3, 0), glm::vec3(1.25f, 11.25f, 21.25f));
  EXPECT_EQ(picture.at(3, 1), glm::vec3(0));
  EXPECT_THAT(picture.warnings, IsEmpty());

  // Larger than the display window, which does not start at 0.
  picture =
      pictureOf(exrOf({{"", colors("", 1), Imath::Box2i({-6, -6}, {9, 9}), Imath::Box2i({-2, 2}, {-1, 2})}}));
  ASSERT_EQ(picture.image.width(), 2);
  ASSERT_EQ(picture.image.height(), 1);
  EXPECT_EQ(picture.at(1, 0), glm::vec3(1 + 5 * .125f + 8 * .0625f, 12.125f, 22.125f));
  EXPECT_THAT(picture.warnings, ElementsAre(HasSubstr("outside of the display window are left out")));

  EXPECT_THAT(errorOfPicture(exrOf({{"", colors("", 1), kWindow, Imath::Box2i({10, 0}, {13, 1})}})),
              HasSubstr("outside of its display window"));
  EXPECT_THAT(errorOfPicture(exrOf({{"", colors("", 1), kWindow, Imath::Box2i({0, 0}, {8191, 4095})}})),
              HasSubstr("4 x 2 pixels alone"));
}

TEST(ExrPicture, OtherPrimariesBecomeRec709) {
  const auto picture = [](const Imf::Chromaticities& chromaticities) {
    return pictureOf(exrOf({{"", {{"R", 1}, {"G", 0}, {"B", 0}}}, {"depth", {{"Z", 1}}}},
                           [&](Imf::Header& header) { Imf::addChromaticities(header, chromaticities); }));
  };
  const auto expectRed = [](const Picture& shown, glm::vec3 rgb) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.at(0, 0)[c], rgb[c], 1e-3f);
    EXPECT_THAT(shown.warnings, IsEmpty());
  };
  expectRed(picture(Imf::Chromaticities()), {1, 0, 0});
  // ITU-R BT.2087: red of BT.2020 in BT.709.
  expectRed(picture({{.708f, .292f}, {.170f, .797f}, {.131f, .046f}, {.3127f, .3290f}}),
            {1.6605f, -.1246f, -.0182f});
  // ACES AP1, whose white is not D65: Bradford, as ACES has it.
  expectRed(picture({{.713f, .293f}, {.165f, .830f}, {.128f, .044f}, {.32168f, .33767f}}),
            {1.7051f, -.1302f, -.0240f});
  const Picture bad = picture({{0, 0}, {0, 0}, {0, 0}, {0, 0}});
  EXPECT_EQ(bad.at(0, 0), glm::vec3(1, 0, 0));
  EXPECT_THAT(bad.warnings, ElementsAre(HasSubstr("no colours")));
}

TEST(ExrPicture, LuminanceAndChroma) {
  const fs::path file = test::testFolder() / "yc.exr";
  std::vector<Imf::Rgba> pixels(64 * 32);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = i % 64 < 32 ? Imf::Rgba(4.0f, 1.0f, 0.5f) : Imf::Rgba(0.5f, 1.0f, 2.0f);
  {
    Imf::RgbaOutputFile output(file.c_str(), 64, 32, Imf::WRITE_YC);
    output.setFrameBuffer(pixels.data(), 1, 64);
    output.writePixels(32);
  }
  const Picture picture = pictureOf(file);
  ASSERT_EQ(picture.image.width(), 64);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.at(8, 16)[c], (glm::vec3(4.0f, 1.0f, 0.5f))[c], 0.02f);
    EXPECT_NEAR(picture.at(56, 16)[c], (glm::vec3(0.5f, 1.0f, 2.0f))[c], 0.02f);
  }
}

TEST(ExrPicture, WhatIsNotSupportedIsNamed) {
  TestPart integers{"", {{"R", 0}, {"G", 0}, {"B", 0}}};
  integers.type = Imf::UINT;
  EXPECT_THAT(errorOfPicture(exrOf({integers})), HasSubstr("channel 'R' is of integers"));
  EXPECT_THAT(errorOfPicture(exrOf({{"", colors("", 1)}},
                                   [](Imf::Header& header) { Imf::addEnvmap(header, Imf::ENVMAP_CUBE); })),
              HasSubstr("a cube map (exrenvmap -latlong"));
}

TEST(ExrPicture, EnvironmentsAreSuchPictures) {
  std::vector<std::string> warnings;
  const Environment environment =
      valueOf(readEnvironment(exrOf({{"depth", {{"Z", 5}}}, {"rgb", colors("", 1)}}), warnings));
  EXPECT_EQ(environment.texel(0, 0), glm::vec3(1, 11, 21));
  EXPECT_THAT(warnings, IsEmpty());
}

/// A file of one part and black pixels, packed as well as its compression can.
fs::path blackPicture(int width, int height, Imf::Compression compression) {
  const fs::path path = test::testFolder() / "black.exr";
  Imf::Header header(width, height);
  header.compression() = compression;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::HALF));
  const std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
  Imf::FrameBuffer buffer;
  for (const char* name : {"R", "G", "B"})
    buffer.insert(
        name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(const_cast<std::uint16_t*>(row.data())), 2, 0));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
  return path;
}

// Compressions pack a picture of one colour into next to nothing: it is read, and the same file
// without its end takes no memory.
TEST(ExrPicture, ClaimsAreProvedBeforeMemoryIsTaken) {
  for (const auto compression : {Imf::DWAB_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::ZIP_COMPRESSION}) {
    const fs::path file = blackPicture(4096, 2048, compression);
    test::Bytes bytes = test::bytesOf(file);
    bytes.erase(bytes.end() - 40, bytes.end());
    test::writeBytes(test::testFolder() / "cut.exr", bytes);
    const std::uint64_t before = test::peakMemory();
    EXPECT_NE(errorOfPicture(test::testFolder() / "cut.exr"), "read") << compression;
    EXPECT_LT(test::peakMemory() - before, std::uint64_t{60} << 20) << compression;
  }
  EXPECT_EQ(pictureOf(blackPicture(4096, 2048, Imf::DWAB_COMPRESSION)).at(4095, 2047), glm::vec3(0));
}

void append(test::Bytes& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.push_back(0);
}
void append(test::Bytes& bytes, std::uint32_t number) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> 8 * i));
}

// OpenEXR takes kilobytes for a channel of 18 bytes.
TEST(ExrPicture, AMillionChannelsTakeNoMemory) {
  test::Bytes bytes{0x76, 0x2f, 0x31, 0x01, 2, 4, 0, 0};
  append(bytes, "channels");
  append(bytes, "chlist");
  test::Bytes list;
  for (int i = 0; i < 1000000; ++i) {
    append(list, std::to_string(i));
    for (const std::uint32_t number : {1u, 0u, 1u, 1u}) append(list, number);
  }
  list.push_back(0);
  append(bytes, static_cast<std::uint32_t>(list.size()));
  bytes.insert(bytes.end(), list.begin(), list.end());
  bytes.push_back(0);
  const fs::path file = test::testFolder() / "channels.exr";
  test::writeBytes(file, bytes);
  const std::uint64_t before = test::peakMemory();
  EXPECT_THAT(errorOfPicture(file), HasSubstr("attributes and channels in a file of"));
  EXPECT_LT(test::peakMemory() - before, std::uint64_t{100} << 20);
}

TEST(ExrPicture, AHundredThousandPartsTakeNoMemory) {
  const test::Bytes whole = test::bytesOf(exrOf({{"a", colors("", 1)}, {"b", colors("", 1)}}));
  const char tag[] = "channels";
  const auto first = std::search(whole.begin(), whole.end(), tag, tag + sizeof tag);
  const auto second = std::search(first + 1, whole.end(), tag, tag + sizeof tag);
  ASSERT_NE(second, whole.end());
  test::Bytes bytes(whole.begin(), whole.begin() + 8);
  for (int i = 0; i < 100000; ++i) bytes.insert(bytes.end(), first, second);
  bytes.push_back(0);
  const fs::path file = test::testFolder() / "parts.exr";
  test::writeBytes(file, bytes);
  const std::uint64_t before = test::peakMemory();
  EXPECT_THAT(errorOfPicture(file), HasSubstr("attributes and channels in a file of"));
  EXPECT_LT(test::peakMemory() - before, std::uint64_t{100} << 20);
}

}  // namespace
}  // namespace weft
