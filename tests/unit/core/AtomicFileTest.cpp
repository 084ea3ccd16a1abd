#include "weft/core/AtomicFile.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

std::string textOf(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::size_t filesIn(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, AppearsOnCommitAndReplacesWhatWasThere) {
  const fs::path folder = test::testFolder();
  const fs::path target = folder / "out.txt";
  write(target, "old");
  {
    AtomicFile file = valueOf(AtomicFile::create(target));
    EXPECT_EQ(file.temporary().parent_path(), folder);
    write(file.temporary(), "new");
    EXPECT_EQ(textOf(target), "old");
    requireDone(file.commit());
    EXPECT_EQ(textOf(target), "new");
  }
  EXPECT_EQ(textOf(target), "new");
  EXPECT_EQ(filesIn(folder), 1u);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
  const fs::path folder = test::testFolder();
  write(folder / "out.txt", "old");
  {
    const AtomicFile file = valueOf(AtomicFile::create(folder / "out.txt"));
    write(file.temporary(), "new");
    write(file.temporary().string() + ".XyZ", "a library's own temporary");
  }
  EXPECT_EQ(textOf(folder / "out.txt"), "old");
  EXPECT_EQ(filesIn(folder), 1u);
}

TEST(AtomicFile, TwoMayWriteToOneTarget) {
  const fs::path folder = test::testFolder();
  AtomicFile first = valueOf(AtomicFile::create(folder / "out.txt"));
  AtomicFile second = valueOf(AtomicFile::create(folder / "out.txt"));
  EXPECT_NE(first.temporary(), second.temporary());
  write(first.temporary(), "first");
  write(second.temporary(), "second");
  requireDone(second.commit());
  requireDone(first.commit());
  EXPECT_EQ(textOf(folder / "out.txt"), "first");
}

TEST(AtomicFile, RefusesFoldersAndMissingFolders) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(AtomicFile::create(folder).error().message(), HasSubstr("the output is a folder"));
  EXPECT_THAT(AtomicFile::create(folder / "none" / "out.txt").error().message(),
              HasSubstr("the folder of the output does not exist"));
}

TEST(AtomicFileDeathTest, AnInterruptionRemovesAllAndAllowsNoMore) {
  const fs::path folder = test::testFolder();
  const auto interrupted = [&] {
    AtomicFile first = valueOf(AtomicFile::create(folder / "a.txt"));
    AtomicFile second = valueOf(AtomicFile::create(folder / "b.txt"));
    write(first.temporary(), "half");
    write(second.temporary().string() + ".XyZ", "written");
    AtomicFile::removeAllPending();
    const bool stopped = filesIn(folder) == 0 && !first.commit() && !AtomicFile::create(folder / "c.txt");
    _exit(stopped ? 7 : 1);
  };
  EXPECT_EXIT(interrupted(), testing::ExitedWithCode(7), "");
  EXPECT_EQ(filesIn(folder), 0u);
}

TEST(AtomicFile, WholeFilesReplaceWhatWasThere) {
  const fs::path target = test::testFolder() / "out.txt";
  write(target, "something longer");
  requireDone(writeWholeFile(target, std::string_view("a\0b", 3)));
  EXPECT_EQ(textOf(target), std::string("a\0b", 3));
  EXPECT_FALSE(writeWholeFile(target / "below", "text"));
}

}  // namespace
}  // namespace weft
