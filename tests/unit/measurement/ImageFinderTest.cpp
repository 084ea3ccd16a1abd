// Which images a light list means.
#include <gmock/gmock.h>

#include "LightListFiles.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::errorOfOpening;
using test::imagesOf;
using test::valueOf;
using test::warningsOf;
using test::writeImage;
using test::writeList;
using testing::AllOf;
using testing::HasSubstr;

// A list of one image that calls it `listed`, among images of the values 10, 20, ...
fs::path listOf(const std::string& listed, const std::vector<std::string>& images) {
  const fs::path folder = test::testFolder();
  int value = 0;
  for (const std::string& image : images) writeImage(folder / image, value += 10);
  return writeList(folder / "dirs.lp", "1\n" + listed + " 0 0 1\n");
}

void expectFound(const std::string& listed, const std::vector<std::string>& images, int value) {
  const auto source = openBtf(listOf(listed, images));
  ASSERT_TRUE(source) << source.error().message();
  EXPECT_EQ(imagesOf(**source), std::vector{value}) << listed;
}

TEST(ImageFinder, FindsNamesWithAnotherExtension) {
  expectFound("img00.CR2", {"img01.png", "img00.png"}, 20);
  expectFound("D:\\raw\\img00.CR2", {"img00.PNG"}, 10);
  expectFound("img00", {"img00.png"}, 10);
  const auto source = valueOf(openBtf(listOf("img00.CR2", {"img00.png"})));
  EXPECT_EQ(
      warningsOf(*source),
      "images are taken whose names differ from the list's in the extension: img00.png for img00.CR2\n");
  EXPECT_THAT(errorOfOpening(listOf("img00.CR2", {"img001.png", "img0.png"})),
              HasSubstr("there is no image 'img00.CR2'"));
}

TEST(ImageFinder, FindsNamesInAnotherCase) {
  expectFound("IMG_1.JPG", {"img_1.jpg", "img_2.jpg"}, 10);
  expectFound("Img_1.png", {"img_1.PNG", "IMG_1.tif.png"}, 10);
  expectFound("M\u00dcNZE.PNG", {"m\u00fcnze.png"}, 10);
  EXPECT_EQ(warningsOf(*valueOf(openBtf(listOf("IMG_1.PNG", {"img_1.png"})))), "");
}

TEST(ImageFinder, FindsNamesInAnotherNormalForm) {
  expectFound("Mu\u0308nze.png", {"M\u00fcnze.png", "Munze.png"}, 10);
  expectFound("M\u00fcnze.png", {"Mu\u0308nze.png", "Munze.png"}, 10);
  expectFound("M\xfcnze.png", {"M\u00fcnze.png"}, 10);  // the list in Latin-1
  expectFound("M\xfcnze.png", {"M\xfcnze.png"}, 10);
}

TEST(ImageFinder, PrefersTheSameFolderAndCase) {
  expectFound("a.png", {"A.png", "a.png"}, 20);
  expectFound("C:\\x\\a.png", {"A.png", "a.png"}, 20);
  expectFound("a.png", {"a.png", "jpeg-exports/a.png"}, 10);
  expectFound("C:\\coin\\jpeg-exports\\a.png", {"a.png", "jpeg-exports/a.png"}, 20);
  expectFound("a.png", {"a.jpg", "a.png"}, 20);
}

TEST(ImageFinder, NamesBothThatFitEquallyWell) {
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"img00.CR2", {"img00.jpg", "img00.png"}},
      {"a.png", {"A.png", "a.PNG"}},
      {"C:\\coin\\jpeg-exports\\a.png", {"jpeg-exports/A.png", "jpeg-exports/a.PNG"}}};
  for (const auto& [listed, images] : cases)
    EXPECT_THAT(errorOfOpening(listOf(listed, images)),
                AllOf(HasSubstr("dirs.lp, line 2: '"), HasSubstr("' may be '"), HasSubstr(images[0]),
                      HasSubstr(images[1])));
}

TEST(ImageFinder, LooksIntoTheFoldersOfTheListAlone) {
  EXPECT_THAT(errorOfOpening(listOf("a.png", {"other/a.png"})), HasSubstr("there is no image 'a.png'"));
  expectFound("other\\a.png", {"other/a.png"}, 10);
  expectFound("E:\\coin\\other\\a.png", {"other/a.png"}, 10);
  EXPECT_THAT(errorOfOpening(listOf("a.png", {".a.png", "thumbs/a.png"})),
              HasSubstr("there is no image 'a.png'"));
}

TEST(ImageFinder, TellsWhatAFileIsThatIsNoJpegOrPng) {
  const fs::path list = listOf("a.tif", {"b.png"});
  test::writeBytes(list.parent_path() / "a.tif", {'I', 'I', '*', 0, 8, 0, 0, 0, 0, 0});
  EXPECT_THAT(errorOfOpening(list), HasSubstr("dirs.lp: a.tif: this is "));
  writeImage(list.parent_path() / "a.png", 20);
  EXPECT_EQ(imagesOf(*valueOf(openBtf(list))), std::vector{20});
}

TEST(ImageFinder, TheSameImageTwiceIsRefused) {
  const fs::path list = listOf("a.png", {"a.png"});
  writeList(list, "2\na.CR2 0 0 1\nA.PNG 0 1 1\n");
  EXPECT_THAT(errorOfOpening(list),
              AllOf(HasSubstr("dirs.lp, line 3: the same image as "), HasSubstr(", line 2")));
}

}  // namespace
}  // namespace weft
