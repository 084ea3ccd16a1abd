#include "weft/measurement/BtfSource.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>

#include "LightListFiles.h"
#include "Samples.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::errorOfOpening;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

constexpr int kWidth = 5;
constexpr int kHeight = 4;

// The byte of a made-up measurement; any two images differ.
int storedValue(int view, int light, int x, int y, int c) {
  return (17 + 61 * view + 29 * light + 7 * x + 13 * y + 5 * c) % 256;
}

Image pairImage(int view, int light) {
  return test::imageOf(kWidth, kHeight,
                       [&](int x, int y, int c) { return storedValue(view, light, x, y, c); });
}

// Three views and two lights in UTIA's naming, written in an order that is not the sorted one. PNG,
// so that values are exact.
fs::path makeFolder() {
  const fs::path folder = test::testFolder() / "cloth";
  const std::vector<std::string> views{"tv000_pv000", "tv030_pv090", "tv030_pv180"};
  const std::vector<std::string> lights{"tl000_pl000", "tl075_pl345"};
  for (int view : {2, 0, 1})
    for (int light : {1, 0}) {
      const std::string viewName = views[static_cast<std::size_t>(view)];
      fs::create_directories(folder / viewName);
      const std::string file = lights[static_cast<std::size_t>(light)] + "_" + viewName + ".png";
      requireDone(writePng(folder / viewName / file, pairImage(view, light)));
    }
  test::writeBytes(folder / "readme.txt", {'h', 'i'});
  test::writeBytes(folder / "tv000_pv000" / "preview.png", {'n', 'o'});
  return folder;
}

fs::path anImageOf(const fs::path& folder) {
  return folder / "tv030_pv090" / "tl075_pl345_tv030_pv090.png";
}

glm::vec3 storedColor(int view, int light, int x, int y) {
  return glm::vec3(storedValue(view, light, x, y, 0), storedValue(view, light, x, y, 1),
                   storedValue(view, light, x, y, 2)) /
         255.0f;
}

// The linear RGB of a texel, all its pairs.
std::vector<glm::vec3> texelOf(const SampleRows& rows, int x, int y) {
  std::vector<glm::vec3> texel(rows.pairs());
  rows.linear(y, x, texel);
  return texel;
}

std::string errorOfReading(const fs::path& path) {
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(path));
  SampleRows rows;
  const auto result = source->readRows(0, source->description().height, rows);
  return result ? "read" : result.error().message();
}

void expectMadeUpRows(const SampleRows& rows, int first, int count) {
  ASSERT_EQ(rows.rows(), count);
  ASSERT_EQ(rows.columns(), kWidth);
  ASSERT_EQ(rows.pairs(), 6u);
  std::vector<glm::vec3> stored(6);
  for (int y = 0; y < count; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const std::vector<glm::vec3> linear = texelOf(rows, x, y);
      rows.stored(y, x, stored);
      for (std::size_t pair = 0; pair < 6; ++pair) {
        const glm::vec3 expected =
            storedColor(static_cast<int>(pair / 2), static_cast<int>(pair % 2), x, first + y);
        ASSERT_EQ(stored[pair], expected);
        ASSERT_EQ(linear[pair], decode(Encoding::Srgb, expected));
      }
    }
}

void expectMadeUpMeasurement(const BtfSource& source) {
  const BtfDescription& d = source.description();
  EXPECT_EQ(d.name, "cloth");
  EXPECT_EQ(d.width, kWidth);
  EXPECT_EQ(d.height, kHeight);
  EXPECT_EQ(d.encoding, Encoding::Srgb);
  EXPECT_TRUE(d.cosineInData);
  ASSERT_EQ(d.views, (std::vector<glm::vec3>{directionFromDegrees(0, 0), directionFromDegrees(30, 90),
                                             directionFromDegrees(30, 180)}));
  ASSERT_EQ(d.lights, (std::vector<glm::vec3>{directionFromDegrees(0, 0), directionFromDegrees(75, 345)}));
  EXPECT_TRUE(d.storedAsBytes);
  expectMadeUpRows(test::allRows(source), 0, kHeight);
}

TEST(BtfSource, ReadsAFolderExactly) {
  expectMadeUpMeasurement(*valueOf(openBtf(makeFolder())));
}

TEST(BtfSource, NamesAFolderThatEndsInASlash) {
  expectMadeUpMeasurement(*valueOf(openBtf(makeFolder() / "")));
}

TEST(BtfSource, ReadsStoredAndDeflatedZipsExactly) {
  const fs::path folder = makeFolder();
  const fs::path zip = folder.parent_path() / "cloth.zip";
  for (const bool deflate : {false, true}) {
    test::zipFolder(folder, zip, deflate);
    expectMadeUpMeasurement(*valueOf(openBtf(zip)));
  }
}

TEST(BtfSource, ReadsSomeRowsAfterOthersIntoTheSameMemory) {
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(makeFolder()));
  SampleRows rows;
  for (const auto& [first, count] : {std::pair(0, 2), std::pair(2, 1), std::pair(3, 1), std::pair(1, 3)}) {
    requireDone(source->readRows(first, count, rows));
    expectMadeUpRows(rows, first, count);
  }
}

TEST(BtfSource, ReadsSomePairsOfATexel) {
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(makeFolder()));
  const SampleRows rows = test::allRows(*source);
  std::vector<glm::vec3> view(2);
  rows.stored(3, 4, view, 2);
  EXPECT_EQ(view, (std::vector{storedColor(1, 0, 4, 3), storedColor(1, 1, 4, 3)}));
}

TEST(BtfSource, FitsRowsIntoMemory) {
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(makeFolder()));
  constexpr std::size_t rowBytes = kWidth * 3 * 2 * 3;
  EXPECT_EQ(source->rowsWithin(0), 1);
  EXPECT_EQ(source->rowsWithin(3 * rowBytes - 1), 2);
  EXPECT_EQ(source->rowsWithin(3 * rowBytes), 3);
  EXPECT_EQ(source->rowsWithin(std::size_t{1} << 40), kHeight);
}

TEST(BtfSource, MayBeReadFromManyThreads) {
  const fs::path folder = makeFolder();
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, true);
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(zip));
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i)
    threads.emplace_back([&, first = i % 3] {
      SampleRows rows;
      for (int repeat = 0; repeat < 20; ++repeat) {
        requireDone(source->readRows(first, 2, rows));
        expectMadeUpRows(rows, first, 2);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(BtfSource, DecodesJpegsWithGamma22) {
  const fs::path folder = test::testFolder() / "jpeg";
  const Image image = test::imageOf(16, 16, [](int, int, int c) { return 60 + 70 * c; });
  test::writeBytes(folder / "tl000 pl000 tv000 pv000.jpg", valueOf(encodeJpeg(image, 95)));
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(folder));
  EXPECT_EQ(source->description().encoding, Encoding::Gamma22);
  const SampleRows rows = test::allRows(*source);
  for (int texel = 0; texel < 256; ++texel) {
    const glm::vec3 rgb = test::linearSample(rows, texel % 16, texel / 16, 0);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(std::pow(rgb[c], 1.0f / 2.2f), (60.0f + 70.0f * static_cast<float>(c)) / 255.0f,
                  1.5f / 255.0f);
  }
}

// More pixels than are decoded before they are transposed.
TEST(BtfSource, ReadsLargeImagesInBatches) {
  constexpr int kSide = 4096;
  const fs::path folder = test::testFolder();
  for (int light = 0; light < 3; ++light) {
    Image image(kSide, kSide, 3);
    std::ranges::fill(image.bytes, static_cast<std::uint8_t>(60 * (light + 1)));
    const std::string name = "tl0" + std::to_string(15 * light + 10) + " pl000 tv000 pv000.jpg";
    test::writeBytes(folder / name, valueOf(encodeJpeg(image, 95)));
  }
  SampleRows rows;
  requireDone(valueOf(openBtf(folder))->readRows(kSide - 1, 1, rows));
  std::vector<glm::vec3> texel(3);
  for (const int x : {0, 1, kSide / 2, kSide - 1}) {
    rows.stored(0, x, texel);
    for (int light = 0; light < 3; ++light)
      EXPECT_NEAR(texel[static_cast<std::size_t>(light)].y * 255.0f, 60.0f * static_cast<float>(light + 1),
                  1.01f);
  }
}

TEST(BtfSource, ReadsGreyImagesAsRgb) {
  const fs::path folder = test::testFolder();
  Image grey(3, 1, 1);
  grey.bytes = {0, 100, 255};
  requireDone(writePng(folder / "tl000_pl000_tv000_pv000.png", grey));
  const SampleRows rows = test::allRows(*valueOf(openBtf(folder)));
  EXPECT_EQ(test::linearSample(rows, 0, 0, 0), glm::vec3(0.0f));
  EXPECT_EQ(test::linearSample(rows, 1, 0, 0), glm::vec3(decode(Encoding::Srgb, 100.0f / 255.0f)));
  EXPECT_EQ(test::linearSample(rows, 2, 0, 0), glm::vec3(1.0f));
}

// As they are stored, encoded like 8 bits, whatever the file says of gamma; an image of 8 bits
// among them too.
TEST(BtfSource, KeepsAllBitsOfWideImages) {
  const fs::path folder = test::testFolder();
  test::writeBytes(folder / "tl000_pl000_tv000_pv000.png",
                   test::widePng(2, 2, [](int x, int y, int c) { return 20000 + 10 * x + 100 * y + c; }));
  requireDone(writePng(folder / "tl030_pl000_tv000_pv000.png",
                       test::imageOf(2, 2, [](int x, int y, int c) { return 80 + 3 * (2 * y + x) + c; })));
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(folder));
  EXPECT_FALSE(source->description().storedAsBytes);
  const SampleRows rows = test::allRows(*source);
  const auto expectStored = [&](std::size_t pair, glm::vec3 stored) {
    const glm::vec3 linear = test::linearSample(rows, 1, 1, pair), expected = decode(Encoding::Srgb, stored);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear[c], expected[c], 1e-6f) << pair;
  };
  expectStored(0, glm::vec3(20110, 20111, 20112) / 65535.0f);
  expectStored(1, glm::vec3(89, 90, 91) / 255.0f);
}

// Of the same scene, seen by a camera that was held otherwise.
TEST(BtfSource, TurnsPhotographsAsTheirExifSays) {
  const fs::path folder = test::testFolder();
  // the upper left of 16 x 32
  const auto bright = [](int x, int y) { return x < 8 && y < 16 ? 200 : 40; };
  const Image upright = test::imageOf(16, 32, [&](int x, int y, int) { return bright(x, y); });
  const Image lying = test::imageOf(32, 16, [&](int x, int y, int) { return bright(15 - y, x); });
  test::Bytes turned = valueOf(encodeJpeg(lying, 95));
  const test::Bytes exif{0xff, 0xe1, 0, 34, 'E', 'x', 'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8,
                         0,    1,    1, 18, 0,   3,   0,   0,   0, 1, 0,   6,   0, 0,  0, 0, 0, 0};
  turned.insert(turned.begin() + 2, exif.begin(), exif.end());
  test::writeBytes(folder / "tl000 pl000 tv000 pv000.jpg", turned);
  test::writeBytes(folder / "tl030 pl000 tv000 pv000.jpg", valueOf(encodeJpeg(upright, 95)));
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(folder));
  ASSERT_EQ(source->description().width, 16);
  ASSERT_EQ(source->description().height, 32);
  const SampleRows rows = test::allRows(*source);
  for (const int y : {2, 13, 18, 29})
    for (const int x : {2, 13})
      EXPECT_NEAR(test::linearSample(rows, x, y, 0).x, test::linearSample(rows, x, y, 1).x, 0.02f)
          << x << ' ' << y;
}

TEST(BtfSource, RefusesAMissingPair) {
  const fs::path folder = makeFolder();
  fs::remove(anImageOf(folder));
  EXPECT_THAT(errorOfOpening(folder),
              HasSubstr("no image for light (theta 75, phi 345) and view (theta 30, phi 90)"));
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("3 views x 2 lights need 6 images, 5 are there"));
}

TEST(BtfSource, RefusesADuplicatePair) {
  const fs::path folder = makeFolder();
  fs::copy(anImageOf(folder), folder / "again tl075 pl345 tv030 pv090.png");
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("the same light and view as"));
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("tl075_pl345_tv030_pv090.png"));
}

TEST(BtfSource, RefusesMixedFormats) {
  const fs::path folder = makeFolder();
  fs::rename(anImageOf(folder), anImageOf(folder).replace_extension(".jpg"));
  EXPECT_THAT(errorOfOpening(folder), HasSubstr("JPEGs and PNGs are mixed"));
}

TEST(BtfSource, RefusesImagesOfDifferentSizes) {
  const fs::path folder = makeFolder();
  requireDone(writePng(anImageOf(folder), Image(kWidth + 1, kHeight, 3)));
  EXPECT_THAT(errorOfReading(folder), HasSubstr("tl075_pl345_tv030_pv090.png: the image has 6 x 4 pixels"));
}

TEST(BtfSource, RefusesWhatIsNoImage) {
  const fs::path folder = makeFolder();
  test::writeBytes(anImageOf(folder), {'n', 'o', 't', ' ', 'a', 'n', ' ', 'i', 'm', 'a', 'g', 'e'});
  EXPECT_THAT(errorOfReading(folder),
              HasSubstr("tl075_pl345_tv030_pv090.png: this is a text, not a JPEG or PNG"));
  test::writeBytes(anImageOf(folder), {});
  EXPECT_THAT(errorOfReading(folder),
              HasSubstr("tl075_pl345_tv030_pv090.png: this is an empty file, not a JPEG or PNG"));
}

TEST(BtfSource, RefusesATruncatedImage) {
  const fs::path folder = makeFolder();
  test::Bytes bytes = test::bytesOf(anImageOf(folder));
  bytes.erase(bytes.end() - 30, bytes.end());
  test::writeBytes(anImageOf(folder), bytes);
  EXPECT_THAT(errorOfReading(folder), HasSubstr("tl075_pl345_tv030_pv090.png: the PNG is damaged"));
}

TEST(BtfSource, RefusesATruncatedZip) {
  const fs::path folder = makeFolder();
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, false);
  const test::Bytes whole = test::bytesOf(zip);
  for (std::size_t size = 1; size < whole.size(); size += 97) {
    test::writeBytes(zip, test::Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    ASSERT_THAT(errorOfOpening(zip),
                HasSubstr(size < 4 ? "cloth.zip: this is a text" : "cloth.zip: not a complete zip"))
        << size;
  }
}

TEST(BtfSource, RefusesADamagedEntry) {
  const fs::path folder = makeFolder();
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, false);
  test::Bytes bytes = test::bytesOf(zip);
  const std::string name = "tl075_pl345_tv030_pv090.png";
  const auto entry = std::search(bytes.begin(), bytes.end(), name.begin(), name.end());
  ASSERT_NE(entry, bytes.end());
  *(entry + static_cast<std::ptrdiff_t>(name.size()) + 60) ^= 1;
  test::writeBytes(zip, bytes);
  EXPECT_THAT(errorOfReading(zip), HasSubstr("tl075_pl345_tv030_pv090.png: the entry of the zip is damaged"));
}

// The central directory's entry claims to unpack to 4 GB - 1.
TEST(BtfSource, RefusesAnEntryThatUnpacksToTooMuch) {
  const fs::path folder = makeFolder();
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, true);
  test::Bytes bytes = test::bytesOf(zip);
  for (const auto& [signature, sizeOffset] : {std::pair{"PK\3\4", 22}, std::pair{"PK\1\2", 24}})
    for (auto at = bytes.begin();;) {
      at = std::search(at, bytes.end(), signature, signature + 4);
      if (at == bytes.end()) break;
      std::copy_n("\xfe\xff\xff\xff", 4, at + sizeOffset);
      at += 4;
    }
  test::writeBytes(zip, bytes);
  EXPECT_THAT(errorOfOpening(zip), HasSubstr("the entry unpacks to 4294967294 bytes"));
}

TEST(BtfSource, MissingMemoryIsAnError) {
  BtfDescription petabytes;
  petabytes.width = 1 << 24;
  petabytes.views = petabytes.lights = std::vector(1000, glm::vec3(0, 0, 1));
  petabytes.name = "huge";
  SampleRows rows;
  const auto result = rows.allocate(petabytes, 1000);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message(), HasSubstr("huge: there is no memory for 201326592000000000 bytes"));
}

// conventions.md, "Cosine": measured on the wool seen from above, lights at 15, 30, 45 and 60
// degrees.
TEST(BtfSource, WoolFallsOffWithTheCosine) {
  WEFT_DATA_FILE(zip, "ubo2003/UBO_WOOL64.zip");
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(zip));
  const BtfDescription& d = source->description();
  ASSERT_EQ(d.views.size(), 81u);
  ASSERT_EQ(d.lights.size(), 81u);
  ASSERT_EQ(d.width, 64);
  ASSERT_EQ(d.height, 64);
  EXPECT_EQ(d.views, d.lights);
  const SampleRows rows = test::allRows(*source);
  std::vector<double> sumOfLight(81);  // of the top view
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::vector<glm::vec3> texel = texelOf(rows, x, y);
      for (std::size_t light = 0; light < 81; ++light)
        sumOfLight[light] += static_cast<double>(luminance(texel[light]));
    }
  const auto meanOfLights = [&](std::ptrdiff_t first, std::ptrdiff_t count) {
    const auto start = sumOfLight.begin() + first;
    return std::accumulate(start, start + count, 0.0) / static_cast<double>(count);
  };
  const double headOn = meanOfLights(0, 1);
  EXPECT_NEAR(meanOfLights(1, 6) / headOn, 0.963, 0.02);
  EXPECT_NEAR(meanOfLights(7, 12) / headOn, 0.853, 0.02);
  EXPECT_NEAR(meanOfLights(19, 18) / headOn, 0.713, 0.02);
  EXPECT_NEAR(meanOfLights(37, 20) / headOn, 0.463, 0.02);
}

}  // namespace
}  // namespace weft
