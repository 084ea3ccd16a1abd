#include "weft/core/FileKind.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>
#include <vector>

#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using namespace std::literals;

FileKind kindOf(std::string_view text) {
  return fileKind(std::vector<std::uint8_t>(text.begin(), text.end()));
}

TEST(FileKind, IsToldByTheFirstBytes) {
  const std::pair<std::string_view, FileKind> files[] = {
      {"", FileKind::Empty},
      {"12\nimage.jpg 0 0 1\n", FileKind::Text},
      {"\xff\xfe\x31\0\n\0"sv, FileKind::Text},
      {"\xef\xbb\xbf"
       "12\nB\xc3\xa4r.jpg 0 0 1",
       FileKind::Text},
      {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", FileKind::Radiance},
      {"#?RGBE\n", FileKind::Radiance},
      {"#HSH1.2\r\n3\r\n", FileKind::HshRti},
      {"PTM_1.2\nPTM_FORMAT_LRGB\n", FileKind::Ptm},
      {"!DFMF08FCR\x10\0"sv, FileKind::BonnBtf},
      {"glTF\2\0\0\0"sv, FileKind::Glb},
      {"\n { \"asset\": {", FileKind::Json},
      {"\xef\xbb\xbf{\"asset\"", FileKind::Json},
      {" <!DOCTYPE HTML><title>404", FileKind::Html},
      {"<HTML lang=de>", FileKind::Html},
      {"version https://git-lfs.github.com/spec/v1\n", FileKind::GitLfsPointer},
      {"PK\3\4\x14\0"sv, FileKind::Zip},
      {"PK\5\6\0\0"sv, FileKind::Zip},
      {"7z\xbc\xaf\x27\x1c\0"sv, FileKind::Archive},
      {"\x1f\x8b\x08\0"sv, FileKind::Archive},
      {"\x89PNG\r\n\x1a\n\0"sv, FileKind::Png},
      {"\xff\xd8\xff\xe0\0"sv, FileKind::Jpeg},
      {"\x76\x2f\x31\x01\2"sv, FileKind::Exr},
      {"II*\0\x10\0"sv, FileKind::Tiff},
      {"MM\0*\0\0"sv, FileKind::Tiff},
      {"RIFF\0\0\0\0WEBPVP8"sv, FileKind::Webp},
      {"\0\0\0\x18"
       "ftypheic"sv,
       FileKind::OtherImage},
      {"\x89HDF\r\n\x1a\n\0"sv, FileKind::Hdf5},
      {"\x89PNG but no image\0"sv, FileKind::Unknown},
      {"\0\1\2\3"sv, FileKind::Unknown}};
  for (const auto& [text, kind] : files) EXPECT_EQ(kindOf(text), kind) << text;
}

TEST(FileKind, OfATarIsFarInside) {
  std::string tar(512, '\0');
  tar.replace(0, 9, "image.png");
  tar.replace(257, 5, "ustar");
  EXPECT_EQ(kindOf(tar), FileKind::Archive);
}

TEST(FileKind, OfAFileIsThatOfItsBytes) {
  const fs::path file = test::testFolder() / "wool.zip";
  std::ofstream(file, std::ios::binary) << "glTF\2";
  EXPECT_EQ(fileKind(file), FileKind::Glb);
  EXPECT_EQ(fileKind(file.parent_path()), FileKind::Unknown);
  EXPECT_EQ(fileKind(file.parent_path() / "none"), FileKind::Unknown);
  const fs::path fifo = file.parent_path() / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(fileKind(fifo), FileKind::Unknown) << "without waiting for a writer";
}

TEST(FileKind, IsSaidWithWhatTakesIt) {
  EXPECT_EQ(failOtherKind(FileKind::Glb, "a measurement", "chair.zip").value().message(),
            "chair.zip: this is a glTF scene (.glb), not a measurement (weft-render draws glTF scenes)");
  EXPECT_EQ(failOtherKind(FileKind::Unknown, "a measurement", "a.zip").value().message(),
            "a.zip: this is not a measurement");
}

}  // namespace
}  // namespace weft
