// Folders and zips of images named by their angles: which names are understood, and that none is
// lost without a word.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "LightListFiles.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::errorOfOpening;
using test::requireDone;
using test::valueOf;
using test::warningsOf;
using test::writeImage;
using testing::AllOf;
using testing::HasSubstr;

BtfDescription descriptionOf(const std::vector<std::string>& names) {
  const fs::path folder = test::testFolder() / "set";
  for (const std::string& name : names) writeImage(folder / name, 10);
  return valueOf(openBtf(folder))->description();
}

TEST(AngleImages, UnderstandsTheNamesInUse) {
  const Image image(2, 2, 3);
  for (const std::string name :
       {"00008 tl015 pl060 tv030 pv090", "tl015_pl060_tv030_pv090", "img_tv30_pv90_tl15_pl60",
        "tv30.0_pv090.00_tl15.0_pl60", "tl15-pl60-tv30-pv90-final", "tl015 pl420 tv030 pv450"}) {
    const fs::path folder = test::testFolder() / "set";
    fs::create_directories(folder);
    requireDone(writePng(folder / (name + ".PNG"), image));
    const BtfDescription d = valueOf(openBtf(folder))->description();
    EXPECT_EQ(d.lights, std::vector{directionFromDegrees(15, 60)}) << name;
    EXPECT_EQ(d.views, std::vector{directionFromDegrees(30, 90)}) << name;
  }
}

TEST(AngleImages, IgnoresNamesWithoutAllAnglesOrBelowTheHorizon) {
  for (const std::string name :
       {"tl015_pl060_tv030.png", "tl015_pl060_tv095_pv000.png", "atl015_pl0_tv0_pv0.png",
        "tl015_pl060_tv030_pv090.txt", "tl_pl_tv_pv.png"}) {
    const fs::path folder = test::testFolder();
    test::writeBytes(folder / name, {0});
    EXPECT_THAT(errorOfOpening(folder), HasSubstr("no images named by their angles")) << name;
  }
}

TEST(AngleImages, TakesAzimuthsAtThePoleAsOne) {
  const fs::path folder = test::testFolder();
  const Image image(2, 2, 3);
  requireDone(writePng(folder / "tl000_pl000_tv000_pv000.png", image));
  requireDone(writePng(folder / "tl000_pl000_tv000_pv090.png", image));
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("the same light and view as"));
}

TEST(AngleImages, UnderstandsSignsAndDecimals) {
  for (const std::string name : {"tl015_pl-60_tv030_pv-90.png", "tl15.00_pl-60.00_tv30.00_pv270.00.png",
                                 "tv30.0_pv-90.0_tl15.0_pl-60.0.png", "00007 tl+015 pl+300 tv+030 pv+270.png",
                                 "tl015,0_pl-60,00_tv030,0_pv-90,0.png", "TL015_PL300_TV030_PV270.png",
                                 "tl015_pl-420_tv030_pv-450.png", "wool_tl015_pl660_tv030_pv-090_v2.png"}) {
    const BtfDescription d = descriptionOf({name});
    EXPECT_EQ(d.lights, std::vector{directionFromDegrees(15, 300)}) << name;
    EXPECT_EQ(d.views, std::vector{directionFromDegrees(30, 270)}) << name;
    EXPECT_TRUE(d.warnings.empty()) << name;
  }
  EXPECT_EQ(descriptionOf({"tl015.50_pl0_tv007,25_pv0.png"}).lights,
            std::vector{directionFromDegrees(15.5, 0)});
  EXPECT_EQ(descriptionOf({"tl015.50_pl0_tv007,25_pv0.png"}).views,
            std::vector{directionFromDegrees(7.25, 0)});
}

TEST(AngleImages, TakesMinusZeroAsZero) {
  const BtfDescription d = descriptionOf({"tl-0.00_pl-0.00_tv-0_pv-0.png", "tl30.00_pl-0.00_tv0_pv0.png"});
  EXPECT_EQ(d.lights, (std::vector{directionFromDegrees(0, 0), directionFromDegrees(30, 0)}));
  EXPECT_EQ(d.views, std::vector{directionFromDegrees(0, 0)});
}

TEST(AngleImages, TakesAzimuthsOfBothCountsAsTheSame) {
  const fs::path folder = test::testFolder();
  writeImage(folder / "tl030_pl-90_tv000_pv0.png", 10);
  writeImage(folder / "tl030_pl270_tv000_pv0.png", 20);
  EXPECT_THAT(errorOfOpening(folder),
              AllOf(HasSubstr("the same light and view as"), HasSubstr("pl-90"), HasSubstr("pl270")));
}

TEST(AngleImages, AWholeMeasurementIsReadWhateverItsSigns) {
  std::vector<std::string> names;
  for (const std::string light : {"tl000_pl0", "tl030_pl-120", "tl030_pl0", "tl030_pl120"})
    for (const std::string view : {"tv000_pv0", "tv030_pv-180", "tv030_pv-60", "tv030_pv60"})
      names.push_back(light + "_" + view + ".png");
  const BtfDescription d = descriptionOf(names);
  EXPECT_EQ(d.lights.size(), 4u);
  EXPECT_EQ(d.views, (std::vector{directionFromDegrees(0, 0), directionFromDegrees(30, 60),
                                  directionFromDegrees(30, 180), directionFromDegrees(30, 300)}));
  EXPECT_TRUE(d.warnings.empty());
}

TEST(AngleImages, NamesImagesThatAreNotUnderstood) {
  const BtfDescription d =
      descriptionOf({"tl000_pl000_tv000_pv000.png", "tl000_pl000_tv-30_pv000.png", "x.jpg", "y.png", "z.tif",
                     "tl095_pl000_tv000_pv000.png", "readme.txt"});
  EXPECT_EQ(d.views.size(), 1u);
  ASSERT_EQ(d.warnings.size(), 2u);
  EXPECT_EQ(d.warnings[0],
            "4 of the images are not read, whose names do not hold the angles of light and view: "
            "tl000_pl000_tv-30_pv000.png, x.jpg, y.png and 1 more");
  EXPECT_EQ(d.warnings[1],
            "1 of the images is not read, lit or seen from below the horizon: tl095_pl000_tv000_pv000.png");
}

TEST(AngleImages, NamesImagesOfOtherFormats) {
  const fs::path folder = test::testFolder();
  test::writeBytes(folder / "tl000_pl000_tv000_pv000.exr", {1});
  EXPECT_THAT(errorOfOpening(folder),
              HasSubstr("only JPEGs and PNGs are read as measurements, not tl000_pl000_tv000_pv000.exr"));
  writeImage(folder / "tl000_pl000_tv000_pv000.png", 10);
  EXPECT_THAT(warningsOf(*valueOf(openBtf(folder))),
              HasSubstr("which are no JPEGs or PNGs: tl000_pl000_tv000_pv000.exr"));
}

TEST(AngleImages, NamesWhatIsMissing) {
  std::vector<std::string> lights{"tl000 pl000", "tl030 pl000", "tl030 pl120", "tl030 pl240"};
  const fs::path folder = test::testFolder();
  for (const std::string& light : lights)
    for (const std::string view : {"tv000 pv000", "tv030 pv000"})
      writeImage(folder / (light + " " + view + ".png"), 10);
  for (std::size_t i = 1; i < lights.size(); ++i) fs::remove(folder / (lights[i] + " tv030 pv000.png"));
  EXPECT_THAT(
      errorOfOpening(folder),
      AllOf(HasSubstr("no image for light (theta 30, phi 0) and view (theta 30, phi 0), for light (theta 30, "
                      "phi 120) and view (theta 30, phi 0), for light (theta 30, phi 240)"),
            HasSubstr("2 views x 4 lights need 8 images, 5 are there")));
  fs::rename(folder / "tl000 pl000 tv030 pv000.png", folder / "tl000 pl000 tv030 pvv00.png");
  writeImage(folder / "tl000 pl000 tv060 pv000.png", 10);
  EXPECT_THAT(errorOfOpening(folder),
              HasSubstr("no angles are found in the names of tl000 pl000 tv030 pvv00.png"));
}

// The product of its directions, 4 x 10^8, is not walked through.
TEST(AngleImages, ASetOfPairsWithoutACommonDirectionIsRefusedAtOnce) {
  const fs::path folder = test::testFolder();
  for (int i = 1; i <= 2000; ++i)
    test::writeBytes(folder / fmt::format("tl{0:.3f}_pl0_tv{0:.3f}_pv0.png", 0.01 * i), {1});
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("and for 3997997 more pairs"));
}

TEST(AngleImages, PassesOverWhatSystemsLeave) {
  const fs::path folder = test::testFolder() / "files";
  const std::string name = "tl000_pl000_tv000_pv000.png";
  writeImage(folder / "cloth" / name, 10);
  for (const std::string& clutter : {"__MACOSX/cloth/._" + name, "cloth/._" + name, "cloth/thumbs/" + name,
                                     ".Trashes/" + name, "cloth/Thumbs/" + name})
    writeImage(folder / clutter, 20);
  for (const std::string clutter : {".DS_Store", "cloth/.DS_Store", "cloth/Thumbs.db", "cloth/desktop.ini"})
    test::writeBytes(folder / clutter, {1, 2});
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, true);
  for (const fs::path& input : {folder, zip}) {
    const auto source = valueOf(openBtf(input));
    EXPECT_EQ(test::imagesOf(*source), std::vector{10}) << input;
    EXPECT_EQ(warningsOf(*source), "") << input;
  }
}

}  // namespace
}  // namespace weft
