// Light lists as other programs, systems and hands write them.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "LightListFiles.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using namespace std::literals;
using test::errorOfOpening;
using test::imagesOf;
using test::listOfTwo;
using test::valueOf;
using test::warningsOf;
using test::writeImage;
using test::writeList;
using testing::HasSubstr;

const std::vector<glm::vec3> kLights{glm::vec3(0.6f, 0, 0.8f), glm::vec3(0, -0.6f, 0.8f)};

std::string inUtf16(std::u16string_view text, bool isBigEndian) {
  std::string bytes;
  for (const char16_t unit : text) {
    const char high = static_cast<char>(unit >> 8);
    const char low = static_cast<char>(unit & 0xff);
    bytes += isBigEndian ? std::string{high, low} : std::string{low, high};
  }
  return bytes;
}

// The list of two images, as it would be read without its dialect, and without a warning.
void expectPlainList(const std::string& bytes) {
  const auto source = valueOf(openBtf(listOfTwo(bytes)));
  EXPECT_EQ(imagesOf(*source), (std::vector{10, 20})) << bytes;
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(glm::distance(source->description().lights.at(i), kLights[i]), 1e-6f) << bytes;
  EXPECT_EQ(warningsOf(*source), "") << bytes;
}

TEST(LightListDialect, ByteOrderMarks) {
  constexpr std::u16string_view kText = u"\ufeff2\r\na.png 0.6 0 0.8\r\nb.png 0 -0.6 0.8\r\n";
  expectPlainList(
      "\xef\xbb\xbf"
      "2\na.png 0.6 0 0.8\nb.png 0 -0.6 0.8\n");
  expectPlainList(inUtf16(kText, false));
  expectPlainList(inUtf16(kText, true));
}

TEST(LightListDialect, Utf16NamesAreThoseOfTheFiles) {
  const fs::path folder = test::testFolder();
  writeImage(folder / "M\u00fcnze \U0001fa99.png", 10);
  const std::string list = inUtf16(
      u"\ufeff"
      u"1\nM\u00fcnze \U0001fa99.png 0 0 1\n",
      false);
  EXPECT_EQ(imagesOf(*valueOf(openBtf(writeList(folder / "dirs.lp", list)))), std::vector{10});
  for (const std::u16string_view damaged : {u"\ufeff"
                                            u"1\na\xd83e 0 0 1\n"sv,
                                            u"\ufeff"
                                            u"1\na\xdc99 0 0 1\n"sv})
    EXPECT_THAT(errorOfOpening(writeList(folder / "dirs.lp", inUtf16(damaged, false))),
                HasSubstr("dirs.lp, byte 8: the UTF-16 text is damaged"));
  EXPECT_THAT(errorOfOpening(writeList(folder / "dirs.lp", list + "x")),
              HasSubstr("the UTF-16 text is damaged"));
}

TEST(LightListDialect, LineEnds) {
  expectPlainList("2\ra.png 0.6 0 0.8\rb.png 0 -0.6 0.8\r");
  expectPlainList("2\r\na.png 0.6 0 0.8\r\n\r\nb.png 0 -0.6 0.8");
}

TEST(LightListDialect, DecimalCommas) {
  expectPlainList("2\na.png 0,6 0 0,8\nb.png 0,0 -,6 +0,8\n");
}

// RealRTI's item 12 counts 47, lists 48 and has 47 images.
TEST(LightListDialect, ACountThatIsOneOff) {
  const std::string two = "\na.png 0.6 0 0.8\nb.png 0 -0.6 0.8\n";
  const auto warningsOfList = [](const std::string& text, const std::vector<int>& images) {
    const auto source = valueOf(openBtf(listOfTwo(text)));
    EXPECT_EQ(imagesOf(*source), images) << text;
    return warningsOf(*source);
  };
  EXPECT_THAT(warningsOfList("2" + two + "c.png 1 0 1\n", {10, 20}),
              HasSubstr("line 1 counts 2 lights, 3 are listed: 'c.png' is left out, which has no image"));
  EXPECT_THAT(warningsOfList("2\nc.png 1 0 1\na.png 0.6 0 0.8\nb.png 0 -0.6 0.8\n", {10, 20}),
              HasSubstr("'c.png' is left out"));
  EXPECT_THAT(warningsOfList("1" + two, {10}),
              HasSubstr("line 1 counts 1 lights, 2 are listed: 'b.png' is left out"));
  EXPECT_THAT(warningsOfList("3" + two, {10, 20}),
              HasSubstr("line 1 counts 3 lights, 2 are listed: all of them are taken"));
  EXPECT_THAT(errorOfOpening(listOfTwo("2" + two + "c.png 1 0 1\nd.png 1 1 1\n")),
              HasSubstr("dirs.lp: line 1 counts 2 lights, 4 are listed"));
  EXPECT_THAT(errorOfOpening(listOfTwo("3" + two + "c.png 1 0 1\n")),
              HasSubstr("dirs.lp, line 4: there is no image 'c.png'"));
  EXPECT_THAT(errorOfOpening(listOfTwo("2\na.png 0 0 1\nc.png 0 1 1\nd.png 1 1 1\n")),
              HasSubstr("dirs.lp, line 3: there is no image 'c.png', nor those of 1 other lines"));
}

TEST(LightListDialect, AFourthNumberIsNoPartOfTheName) {
  const auto errorOf = [](const std::string& first, const BtfOptions& options = {}) {
    return errorOfOpening(listOfTwo("2\n" + first + "\nb.png 0 -0.6 0.8\n"), options);
  };
  for (const std::string line : {"a.png 0.6 0 0.8 1.0", "a.png 0 0 1 1", "a.png 1 0 0 1 1",
                                 "a.png 0,6 0 0,8 1", "a 0.6 0 0.8 1", "a -6e-1 0 0.8 1"})
    EXPECT_THAT(errorOf(line), HasSubstr("dirs.lp, line 2: more than the three numbers of a light follow"))
        << line;
  EXPECT_THAT(errorOf("a 6 0 8 1"), HasSubstr("dirs.lp, line 2: there is no image 'a 6'"));
  EXPECT_THAT(errorOf("a 6 0 8 1"), HasSubstr("more numbers than three may follow"));
  EXPECT_THAT(errorOf("a 6 0 8 1", {.imagesInOrder = true}), HasSubstr("which may be the first of four"));
}

TEST(LightListDialect, NamesMayEndInNumbers) {
  const fs::path folder = test::testFolder();
  writeImage(folder / "coin 12.png", 10);
  writeImage(folder / "coin.07.png", 20);
  writeImage(folder / "3.png", 30);
  for (const std::string extension : {"", ".png", ".tif"}) {
    const std::string text =
        "3\ncoin 12" + extension + " 0 0 1\ncoin.07" + extension + " 0 1 1\n3" + extension + " 0 1 0.5\n";
    EXPECT_EQ(imagesOf(*valueOf(openBtf(writeList(folder / "dirs.lp", text)))), (std::vector{10, 20, 30}))
        << text;
  }
}

TEST(LightListDialect, RtiBuildersFolders) {
  const fs::path project = test::testFolder() / "coin";
  writeImage(project / "jpeg-exports" / "IMG_1.jpg.png", 30);  // a trap: a longer name
  writeImage(project / "jpeg-exports" / "IMG_1.png", 10);
  writeImage(project / "jpeg-exports" / "IMG_2.png", 20);
  writeImage(project / "finished-files" / "IMG_1.png", 40);
  fs::create_directories(project / "assembly-files");
  const std::string text =
      "2\r\nC:\\Users\\me\\coin\\jpeg-exports\\IMG_1.jpg 0.6 0 0.8\r\nIMG_2.jpg 0 -0.6 0.8\r\n";
  const fs::path list = writeList(project / "assembly-files" / "coin.lp", text);
  for (const fs::path& input : {list, project / "assembly-files", project}) {
    const auto source = valueOf(openBtf(input));
    EXPECT_EQ(imagesOf(*source), (std::vector{10, 20})) << input;
    EXPECT_THAT(warningsOf(*source), HasSubstr("differ from the list's in the extension: "
                                               "../jpeg-exports/IMG_1.png for IMG_1.jpg"))
        << input;
  }
  writeList(list, "2\nX1 0.6 0 0.8\nX2 0 -0.6 0.8\n");
  fs::remove(project / "jpeg-exports" / "IMG_1.jpg.png");
  EXPECT_EQ(imagesOf(*valueOf(openBtf(project, {.imagesInOrder = true}))), (std::vector{10, 20}));
}

TEST(LightListDialect, InAZip) {
  const fs::path folder = test::testFolder() / "files";
  for (const std::string at : {"", "coin/assembly-files"}) {
    fs::remove_all(folder);
    writeImage(folder / at / "a.png", 10);
    writeImage(folder / at / "photos" / "b.png", 20);
    writeImage(folder / "elsewhere" / "b.png", 30);
    const std::string text = "2\nC:\\me\\a.png 0.6 0 0.8\nphotos\\b.png 0 -0.6 0.8\n";
    writeList(folder / at / "dirs.lp", text);
    fs::create_directories(folder / "__MACOSX");
    writeList(folder / "__MACOSX" / "._dirs.lp", "no list");
    const fs::path zip = folder.parent_path() / "coin.zip";
    test::zipFolder(folder, zip, true);
    const auto source = valueOf(openBtf(zip));
    EXPECT_EQ(imagesOf(*source), (std::vector{10, 20})) << at;
    EXPECT_EQ(source->description().name, "coin");
    EXPECT_EQ(source->description().encoding, Encoding::Srgb);
  }
  writeList(folder / "coin" / "assembly-files" / "dirs.lp", "1\nnone.png 0 0 1\n");
  test::zipFolder(folder, folder.parent_path() / "coin.zip", true);
  EXPECT_THAT(errorOfOpening(folder.parent_path() / "coin.zip"),
              HasSubstr("coin.zip: coin/assembly-files/dirs.lp, line 2: there is no image 'none.png'"));
}

TEST(LightListDialect, InTheCurrentFolder) {
  const fs::path folder = listOfTwo("2\nIMG_1.tif 0.6 0 0.8\nIMG_2.tif 0 -0.6 0.8\n").parent_path();
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  for (const std::string list : {"dirs.lp", "./dirs.lp", "."})
    EXPECT_EQ(errorOfOpening(list, {.imagesInOrder = true}), "opened") << list;
  fs::current_path(before);
}

}  // namespace
}  // namespace weft
