#include "weft/io/FileBytes.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "TestImages.h"
#include "TestSupport.h"
#include "UnprivilegedUser.h"
#include "weft/io/EnvironmentFile.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string errorOfBytes(const fs::path& file, std::size_t limit = 100) {
  const auto bytes = readFileBytes(file, limit);
  return bytes ? "read" : bytes.error().message();
}

TEST(FileBytes, AreThoseOfTheFile) {
  const fs::path file = test::testFolder() / "file";
  test::writeBytes(file, {1, 2, 3});
  EXPECT_EQ(test::valueOf(readFileBytes(file, 3)), (test::Bytes{1, 2, 3}));
  EXPECT_EQ(test::valueOf(regularFileSize(file)), 3u);
  EXPECT_THAT(errorOfBytes(file, 2), HasSubstr("file: the file has 3 bytes, more than the 2 allowed"));
}

TEST(FileBytes, SayWhyTheyCannotBeRead) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(errorOfBytes(folder / "none"), HasSubstr("none: no such file"));
  EXPECT_THAT(errorOfBytes(folder), HasSubstr(folder.string() + ": cannot be read: a folder, not a file"));
  EXPECT_THAT(errorOfBytes(folder / std::string(300, 'n')), HasSubstr("cannot be read: File name too long"));
  const fs::path fifo = folder / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_THAT(errorOfBytes(fifo), HasSubstr("fifo: cannot be read: not a file"));
}

TEST(FileBytes, ThatMayNotBeReadAreNotCalledMissing) {
  const fs::path file = test::testFolder() / "folder" / "file";
  test::writeBytes(file, {1});
  for (const fs::path& closed : {file, file.parent_path()}) {
    fs::permissions(closed, fs::perms::none);
    {
      const test::UnprivilegedUser user;
      EXPECT_THAT(errorOfBytes(file), HasSubstr("file: cannot be read: Permission denied"));
    }
    fs::permissions(closed, fs::perms::owner_all);
  }
}

// Opening a pipe that nobody writes to never ends; every reader that is given a path refuses it at
// once.
TEST(FileBytes, NobodyWaitsForAPipe) {
  const fs::path pipe = test::testFolder() / "pipe.rf.exr";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::vector<std::string> warnings;
  for (const std::string& message :
       {errorOfBytes(pipe), readImage(pipe).error().message(), readExr(pipe).error().message(),
        readExrPicture(pipe, warnings).error().message(), environmentNamed(pipe, warnings).error().message(),
        readReflectanceField(pipe, ModelRegistry::builtin()).error().message()})
    EXPECT_THAT(message, HasSubstr("pipe.rf.exr: cannot be read: not a file"));
}

}  // namespace
}  // namespace weft
