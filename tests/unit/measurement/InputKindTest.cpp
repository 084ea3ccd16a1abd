// What is said of an input that is no measurement.
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "LightListFiles.h"
#include "UnprivilegedUser.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using namespace std::literals;
using test::errorOfOpening;
using test::writeImage;
using test::writeList;
using testing::HasSubstr;

TEST(InputKind, RefusesWhatIsNotThere) {
  EXPECT_THAT(errorOfOpening("/no/such/cloth.zip"), HasSubstr("/no/such/cloth.zip: no such file"));
}

TEST(InputKind, RefusesAnEmptyFolder) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(errorOfOpening(folder), HasSubstr(folder.string() + ": there are no images"));
}

TEST(InputKind, RefusesAFileThatIsNoZip) {
  const fs::path file = test::testFolder() / "cloth.zip";
  test::writeBytes(file, {'h', 'i'});
  EXPECT_THAT(errorOfOpening(file), HasSubstr("cloth.zip: this is a text, not a measurement"));
}

TEST(InputKind, IsNamedByTheFirstBytes) {
  const fs::path folder = test::testFolder();
  const std::pair<std::string, std::string> cases[] = {
      {"#HSH1.2\r\n3\r\n320 470 3\r\n", "an RTI file of HSH coefficients (.rti)"},
      {"PTM_1.2\nPTM_FORMAT_RGB\n", "a polynomial texture map (.ptm)"},
      {"\x89PNG\r\n\x1a\n"s, "a PNG image"},
      {"glTF\2\0\0\0"s, "a glTF scene (.glb)"},
      {"\x76\x2f\x31\x01\2\0\0\0"s, "an OpenEXR image"},
      {"<!DOCTYPE html><html>", "a web page"},
      {"", "an empty file"}};
  for (const auto& [bytes, name] : cases)
    for (const std::string file : {"cloth.zip", "cloth.rti", "cloth"})
      EXPECT_THAT(errorOfOpening(writeList(folder / file, bytes)),
                  HasSubstr(file + ": this is " + name + ", not a measurement"));
  EXPECT_THAT(errorOfOpening(writeList(folder / "dirs.lp", "PK\3\4")),
              HasSubstr("dirs.lp: this is a zip, not a light list"));
  EXPECT_THAT(errorOfOpening(writeList(folder / "cloth.zip", "\1\2\3")),
              HasSubstr("cloth.zip: not a complete zip"));
}

TEST(InputKind, AZipMayHaveAnyName) {
  const fs::path folder = test::testFolder() / "files";
  writeImage(folder / "tl000_pl000_tv000_pv000.png", 10);
  const fs::path zip = folder.parent_path() / "cloth.ubo";
  test::zipFolder(folder, zip, true);
  EXPECT_EQ(errorOfOpening(zip), "opened");
}

TEST(InputKind, OtherThingsThanFilesAreRefused) {
  const fs::path fifo = test::testFolder() / "cloth.zip";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_THAT(errorOfOpening(fifo), HasSubstr("cloth.zip: cannot be read: not a file"));
}

TEST(InputKind, PermissionsAreSaid) {
  const fs::path folder = test::testFolder() / "closed";
  writeImage(folder / "tl000_pl000_tv000_pv000.png", 10);
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, true);
  const fs::path list = writeList(folder.parent_path() / "dirs.lp", "1\na.png 0 0 1\n");
  fs::permissions(folder, fs::perms::none);
  for (const fs::path& file : {zip, list}) fs::permissions(file, fs::perms::none);
  for (const fs::path& input : {folder, folder / "cloth.zip", zip, list}) {
    const test::UnprivilegedUser user;
    EXPECT_THAT(errorOfOpening(input), HasSubstr("Permission denied")) << input;
  }
  fs::permissions(folder, fs::perms::owner_all);
}

TEST(InputKind, AnEntryThatUnpacksToMoreThanItCanIsDamaged) {
  const fs::path folder = test::testFolder() / "files";
  writeImage(folder / "tl000_pl000_tv000_pv000.png", 10);
  const fs::path zip = folder.parent_path() / "cloth.zip";
  test::zipFolder(folder, zip, true);
  test::Bytes bytes = test::bytesOf(zip);
  for (const auto& [signature, sizeOffset] : {std::pair{"PK\3\4", 22}, std::pair{"PK\1\2", 24}}) {
    const auto at = std::search(bytes.begin(), bytes.end(), signature, signature + 4);
    ASSERT_NE(at, bytes.end());
    std::copy_n("\0\0\0\x08", 4, at + sizeOffset);  // 128 MiB
  }
  test::writeBytes(zip, bytes);
  EXPECT_THAT(errorOfOpening(zip), HasSubstr("bytes are said to unpack to 134217728"));
}

}  // namespace
}  // namespace weft
