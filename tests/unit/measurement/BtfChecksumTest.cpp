// Measurements are told apart by what was measured, not by what they are called.
#include <gtest/gtest.h>

#include <fstream>

#include "MemoryBtf.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/io/ImageFile.h"
#include "weft/measurement/BtfWriter.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::MemoryBtf;
using test::requireDone;
using test::valueOf;

MemoryBtf greyBtf(float grey) {
  return MemoryBtf(2, 2, [=](int x, int, glm::vec3, glm::vec3 l) {
    return glm::vec3(l.z * grey + 0.1f * static_cast<float>(x));
  });
}

std::uint64_t checksumOf(const fs::path& path) {
  return valueOf(valueOf(openBtf(path))->checksum());
}

void writeGrey(const fs::path& file, int value) {
  requireDone(writePng(file, test::imageOf(2, 2, [&](int, int, int) { return value; })));
}

TEST(BtfChecksum, OfAFolderIsThatOfItsImages) {
  const fs::path parent = test::testFolder();
  const fs::path folder = parent / "cloth";
  const fs::path renamed = parent / "renamed";
  fs::create_directories(folder);
  writeGrey(folder / "tl000_pl000_tv000_pv000.png", 10);
  writeGrey(folder / "tl030_pl000_tv000_pv000.png", 20);
  const std::uint64_t checksum = checksumOf(folder);
  std::ofstream(folder / "readme.txt") << "no image";
  fs::rename(folder, renamed);
  EXPECT_EQ(checksumOf(renamed), checksum);
  writeGrey(renamed / "tl030_pl000_tv000_pv000.png", 21);
  EXPECT_NE(checksumOf(renamed), checksum);
}

TEST(BtfChecksum, SeesWhichImageIsOfWhichDirection) {
  const fs::path one = test::testFolder() / "one", two = test::testFolder() / "two";
  for (const fs::path& folder : {one, two}) fs::create_directories(folder);
  writeGrey(one / "tl000_pl000_tv000_pv000.png", 10);
  writeGrey(one / "tl030_pl000_tv000_pv000.png", 20);
  writeGrey(two / "tl000_pl000_tv000_pv000.png", 20);
  writeGrey(two / "tl030_pl000_tv000_pv000.png", 10);
  EXPECT_NE(checksumOf(one), checksumOf(two));
  fs::rename(two / "tl030_pl000_tv000_pv000.png", two / "tl031_pl000_tv000_pv000.png");
  writeGrey(two / "tl000_pl000_tv000_pv000.png", 10);
  writeGrey(two / "tl031_pl000_tv000_pv000.png", 20);
  EXPECT_NE(checksumOf(one), checksumOf(two)) << "a light elsewhere";
}

TEST(BtfChecksum, OfAZipIsThatOfItsImages) {
  const auto write = [](const char* name, float grey) {
    const MemoryBtf btf = greyBtf(grey);
    const fs::path zip = test::testFolder() / name;
    requireDone(writeBtfZip(zip, btf.description(),
                            [&](int view, std::span<float> out) { return btf.readView(view, out); }));
    return zip;
  };
  const std::uint64_t checksum = checksumOf(write("a.zip", 0.5f));
  EXPECT_EQ(checksumOf(write("b.zip", 0.5f)), checksum);
  EXPECT_NE(checksumOf(write("a.zip", 0.6f)), checksum);
}

TEST(BtfChecksum, OfOtherSourcesIsThatOfTheirSamples) {
  MemoryBtf btf = greyBtf(0.5f);
  const std::uint64_t checksum = valueOf(btf.checksum());
  btf.description().name = "renamed";
  EXPECT_EQ(valueOf(btf.checksum()), checksum);
  btf.description().lights[3].x += 0.01f;
  EXPECT_NE(valueOf(btf.checksum()), checksum);
  EXPECT_NE(valueOf(greyBtf(0.5001f).checksum()), checksum);
}

}  // namespace
}  // namespace weft
