#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "LightListFiles.h"
#include "Samples.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/io/ImageFile.h"
#include "weft/measurement/BtfSource.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::errorOfOpening;
using test::imagesOf;
using test::listOfTwo;
using test::requireDone;
using test::valueOf;
using test::warningsOf;
using test::writeImage;
using test::writeList;
using testing::AllOf;
using testing::HasSubstr;

const BtfOptions kInOrder{.imagesInOrder = true};

TEST(LightList, IsABtfOfOneViewFromTheTop) {
  const std::unique_ptr<BtfSource> source =
      valueOf(openBtf(listOfTwo("2\na.png 0.6 0 0.8\nb.png 0 -0.6 0.8\n")));
  const BtfDescription& d = source->description();
  EXPECT_EQ(d.name, "dirs");
  EXPECT_EQ(d.width, 3);
  EXPECT_EQ(d.height, 2);
  EXPECT_EQ(d.encoding, Encoding::Srgb);
  EXPECT_TRUE(d.cosineInData);
  EXPECT_TRUE(d.storedAsBytes);
  EXPECT_EQ(d.views, std::vector{glm::vec3(0, 0, 1)});
  EXPECT_EQ(d.lights, (std::vector{glm::vec3(0.6f, 0, 0.8f), glm::vec3(0, -0.6f, 0.8f)}));
  EXPECT_EQ(imagesOf(*source), (std::vector{10, 20}));
  const glm::vec3 last = test::linearSample(test::allRows(*source), 2, 1, 1);
  EXPECT_EQ(last, decode(Encoding::Srgb, glm::vec3(23, 24, 25) / 255.0f));
}

TEST(LightList, LightsAreSortedByAngleTogetherWithTheirImages) {
  const fs::path folder = test::testFolder();
  for (int i = 0; i < 4; ++i) writeImage(folder / (std::to_string(i) + ".png"), 10 * i);
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(
      writeList(folder / "x.lp", "4\n0.png 0 0.8 0.6\n1.png 0 0.6 0.8\n2.png 0 0 1\n3.png 0.6 0 0.8\n")));
  EXPECT_EQ(imagesOf(*source), (std::vector{20, 30, 10, 0}));
  EXPECT_EQ(source->description().lights, (std::vector{glm::vec3(0, 0, 1), glm::vec3(0.6f, 0, 0.8f),
                                                       glm::vec3(0, 0.6f, 0.8f), glm::vec3(0, 0.8f, 0.6f)}));
}

TEST(LightList, LightsAreNormalizedAndMayLieBelowTheHorizon) {
  const auto source =
      valueOf(openBtf(listOfTwo("2\r\n  a.png\t+3 0 4e0  \r\n\r\nb.png 0 1 -0.00175\r\n\r\n")));
  const std::vector<glm::vec3>& lights = source->description().lights;
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_LT(glm::distance(lights[0], glm::vec3(0.6f, 0, 0.8f)), 1e-6f);
  EXPECT_LT(glm::distance(lights[1], glm::vec3(0, 1, -0.00175f)), 1e-5f);
  EXPECT_LT(lights[1].z, 0.0f);
  EXPECT_THAT(warningsOf(*source),
              HasSubstr("no weight to images with light on or below the horizon: b.png"));
  EXPECT_THAT(warningsOf(*source),
              HasSubstr("the vectors to the lights, up to 5 long, are taken as directions"));
}

TEST(LightList, RefusesLightsThatAreAllBelowTheHorizon) {
  EXPECT_THAT(errorOfOpening(listOfTwo("2\na.png 0.6 0 -0.8\nb.png 1 0 0\n")),
              HasSubstr("dirs.lp: no light is above the horizon"));
}

TEST(LightList, TheSameLightTwiceIsAMeasurement) {
  const auto source = valueOf(openBtf(listOfTwo("2\na.png 0.6 0 0.8\nb.png 0.6 0 0.8\n")));
  EXPECT_EQ(imagesOf(*source), (std::vector{10, 20}));
  EXPECT_EQ(warningsOf(*source), "");
}

TEST(LightList, FindsImagesByTheirNames) {
  const fs::path folder = test::testFolder();
  writeImage(folder / "my first image.png", 10);
  writeImage(folder / "photos" / "second.png", 20);
  for (const std::string first : {"my first image.png", "./my first image.png", "my  first image.png",
                                  "C:\\Users\\me\\RTI data\\my first image.png",
                                  "\\\\server\\share\\my first image.png", "/home/me/my first image.png"}) {
    const std::string text = "2\n" + first + " 0 0 1\nphotos\\second.png 0 0.6 0.8\n";
    const auto source = openBtf(writeList(folder / "dirs.lp", text));
    if (first == "my  first image.png")  // blanks inside a name count
      EXPECT_FALSE(source);
    else
      EXPECT_EQ(imagesOf(*valueOf(openBtf(folder / "dirs.lp"))), (std::vector{10, 20})) << first;
  }
}

TEST(LightList, TakesImagesInOrderWhereThatIsAskedFor) {
  const fs::path list = listOfTwo("2\nIMG_7.tif 0 0.6 0.8\nIMG_8.tif 0 0 1\n");
  EXPECT_THAT(errorOfOpening(list),
              HasSubstr("dirs.lp, line 2: there is no image 'IMG_7.tif', nor those of 1 other lines"));
  EXPECT_EQ(imagesOf(*valueOf(openBtf(list, kInOrder))), (std::vector{20, 10}));
  writeImage(list.parent_path() / "c.png", 30);
  EXPECT_THAT(errorOfOpening(list, kInOrder), HasSubstr("dirs.lp: 2 lights are listed, 3 images are there"));
  fs::remove(list.parent_path() / "c.png");
  fs::remove(list.parent_path() / "b.png");
  EXPECT_THAT(errorOfOpening(list, kInOrder), HasSubstr("dirs.lp, line 3: there is no image 'IMG_8.tif'"));
}

TEST(LightList, SaysWhereTheOrderIsNotThatOfTheNames) {
  const fs::path list = listOfTwo("2\nb.png 0.6 0 0.8\na.png 0 -0.6 0.8\n");
  const auto source = valueOf(openBtf(list, kInOrder));
  EXPECT_EQ(imagesOf(*source), (std::vector{10, 20}));
  EXPECT_THAT(warningsOf(*source), HasSubstr("the order gives 'a.png' to the line of 'b.png'"));
  EXPECT_EQ(imagesOf(*valueOf(openBtf(list))), (std::vector{20, 10}));
}

TEST(LightList, DoesNotGuessTheOrderOfNamesOfDifferentLengths) {
  const fs::path folder = test::testFolder();
  writeImage(folder / "9.png", 10);
  writeImage(folder / "10.png", 20);
  EXPECT_THAT(errorOfOpening(writeList(folder / "dirs.lp", "2\nx 0 0.6 0.8\ny 0 0 1\n"), kInOrder),
              HasSubstr("dirs.lp: the order of images whose names differ in length is not sure"));
}

TEST(LightList, OnlyItsImagesAreTakenInOrder) {
  const fs::path folder = test::testFolder();
  writeImage(folder / "tl015_pl000_tv000_pv000.png", 40);
  EXPECT_THAT(errorOfOpening(folder, kInOrder),
              HasSubstr("only the images of a light list can be taken in order"));
}

TEST(LightList, AFolderWithOneListIsThatList) {
  const fs::path list = listOfTwo("2\na.png 0.6 0 0.8\nb.png 0 -0.6 0.8\n");
  const fs::path folder = list.parent_path();
  fs::create_directories(folder / "old");
  fs::copy(list, folder / "old" / "other.lp");
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(folder));
  EXPECT_EQ(imagesOf(*source), (std::vector{10, 20}));
  EXPECT_EQ(source->description().name, folder.filename());
  fs::copy(list, folder / "again.LP");
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("there is more than one light list: 'again.LP', 'dirs.lp'"));
  fs::remove(folder / "again.LP");
  writeImage(folder / "tl015_pl000_tv000_pv000.png", 40);
  EXPECT_EQ(imagesOf(*valueOf(openBtf(folder))), std::vector{40});
}

TEST(LightList, RefusesWhatIsNoListNamingTheLine) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "dirs.lp: the list of lights is empty"},
      {"\n", "dirs.lp, line 1: the number of lights is expected, 1 to 1000"},
      {"two\na.png 0 0 1\n", "dirs.lp, line 1: the number of lights is expected"},
      {"2 3\na.png 0 0 1\n", "dirs.lp, line 1: the number of lights is expected"},
      {"0\n", "dirs.lp, line 1: the number of lights is expected"},
      {"-2\n", "dirs.lp, line 1: the number of lights is expected"},
      {"1001\n", "dirs.lp, line 1: the number of lights is expected"},
      {"99999999999999999999\n", "dirs.lp, line 1: the number of lights is expected"},
      {"a.png 0 0 1\nb.png 0 1 1\n", "dirs.lp, line 1: the number of lights is expected"},
      {"4\na.png 0 0 1\nb.png 0 1 1\n", "dirs.lp: line 1 counts 4 lights, 2 are listed"},
      {"1\na.png 0 0 1\nb.png 0 1 1\nb.png 1 1 1\n", "dirs.lp: line 1 counts 1 lights, 3 are listed"},
      {"1\n", "dirs.lp: line 1 counts 1 lights, 0 are listed"},
      {"2\na.png 0 0 1\nb.png 0 1\n", "dirs.lp, line 3: an image and the three numbers"},
      {"2\na.png 0 0 1\n0 0 1\n", "dirs.lp, line 3: an image and the three numbers"},
      {"2\na.png 0 0 1\nb.png 0 0,5,5 1\n", "dirs.lp, line 3: an image and the three numbers"},
      {"2\na.png 0 0 1\nb.png 0 1,000.5 1\n", "dirs.lp, line 3: an image and the three numbers"},
      {"2\na.png,0,0,1\nb.png,0,1,1\n", "dirs.lp, line 2: an image and the three numbers"},
      {"2\na.png 0 0 1x\nb.png 0 0 1\n", "dirs.lp, line 2: an image and the three numbers"},
      {"2\na.png 0 0 1\nb.png 0 nan 1\n", "dirs.lp, line 3: (0, nan, 1) is not the direction"},
      {"2\na.png 0 0 1\nb.png 0 0 inf\n", "dirs.lp, line 3: (0, 0, inf) is not the direction"},
      {"2\na.png 0 0 1\nb.png 0 1e300 1e300\n", "dirs.lp, line 3: (0, 1e+300, 1e+300) is not the direction"},
      {"2\na.png 0 0 1\nb.png 0 0 9e-5\n", "dirs.lp, line 3: (0, 0, 9e-05) is not the direction"},
      {"2\na.png 0 0 1\nc.png 0 0.6 0.8\n", "dirs.lp, line 3: there is no image 'c.png'"},
      {"2\na.png 0 0 1\n./a.png 0 0.6 0.8\n", "dirs.lp, line 3: the same image as "}};
  for (const auto& [text, message] : cases) EXPECT_THAT(errorOfOpening(listOfTwo(text)), HasSubstr(message));
}

TEST(LightList, RefusesBinaryGarbage) {
  const fs::path list = listOfTwo("");
  for (unsigned seed = 0; seed < 200; ++seed) {
    test::Bytes bytes(300);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] =
          static_cast<std::uint8_t>((seed * 7919 + static_cast<unsigned>(i) * 104729) * 2654435761u >> 13);
    if (seed % 2) bytes[0] = '2', bytes[1] = '\n';  // past the first line
    test::writeBytes(list, bytes);
    ASSERT_THAT(errorOfOpening(list), HasSubstr("dirs.lp, line "));
  }
  test::writeBytes(list, test::Bytes((std::size_t{1} << 20) + 1, '1'));
  EXPECT_NE(errorOfOpening(list), "opened");
}

TEST(LightList, NamesTheImageThatCannotBeRead) {
  const fs::path list = listOfTwo("2\na.png 0.6 0 0.8\nb.png 0 -0.6 0.8\n");
  const auto errorOfReading = [&] {
    SampleRows rows;
    const auto result = valueOf(openBtf(list))->readRows(0, 1, rows);
    return result ? "read" : result.error().message();
  };
  requireDone(writePng(list.parent_path() / "b.png", Image(3, 3, 3)));
  EXPECT_THAT(errorOfReading(),
              HasSubstr("dirs.lp: b.png: the image has 3 x 3 pixels, the others have 3 x 2"));
  test::writeBytes(list.parent_path() / "b.png", {'n', 'o'});
  EXPECT_THAT(errorOfReading(), HasSubstr("dirs.lp: b.png: this is a text, not a JPEG or PNG image"));
  test::writeBytes(list.parent_path() / "a.png", {'n', 'o'});
  EXPECT_THAT(errorOfOpening(list), HasSubstr("dirs.lp: a.png: this is a text, not a JPEG or PNG image"));
}

// Every list of RealRTI; light vectors of item 11 are .80 to 1.06 long, and one of item 7 lies
// below the horizon.
TEST(LightList, OpensRealLists) {
  WEFT_DATA_FILE(rti, "rti");
  const std::string kDarkLight =
      "fits give no weight to images with light on or below the horizon: image16.jpg\n";
  const std::pair<const char*, std::size_t> items[] = {{"item1", 60}, {"item2", 47}, {"item5", 49},
                                                       {"item6", 48}, {"item7", 48}, {"item9", 48},
                                                       {"item11", 54}};
  for (const auto& [item, lights] : items) {
    const std::unique_ptr<BtfSource> source = valueOf(openBtf(rti / item));
    const BtfDescription& d = source->description();
    EXPECT_EQ(d.name, item);
    ASSERT_EQ(d.lights.size(), lights) << item;
    EXPECT_GT(d.texels(), 10000u);
    float lowest = 1.0f;
    for (const glm::vec3& light : d.lights) {
      EXPECT_NEAR(glm::length(light), 1.0f, 1e-6f);
      lowest = std::min(lowest, light.z);
    }
    EXPECT_EQ(lowest < 0.0f, item == std::string("item7"));
    EXPECT_GT(lowest, -0.002f);
    EXPECT_EQ(warningsOf(*source), lowest < 0.0f ? kDarkLight : "");
  }
}

}  // namespace
}  // namespace weft
