#include "weft/core/AtomicFile.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "LockedTemporary.h"
#include "TestSupport.h"
#include "TextFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::readText;
using test::requireDone;
using test::valueOf;
using testing::HasSubstr;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
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
    EXPECT_EQ(readText(target), "old");
    requireDone(file.commit());
    EXPECT_EQ(readText(target), "new");
  }
  EXPECT_EQ(readText(target), "new");
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
  EXPECT_EQ(readText(folder / "out.txt"), "old");
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
  EXPECT_EQ(readText(folder / "out.txt"), "first");
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
  EXPECT_EQ(readText(target), std::string("a\0b", 3));
  EXPECT_FALSE(writeWholeFile(target / "below", "text"));
}

std::string refusal(const fs::path& target) {
  const auto file = AtomicFile::create(target);
  return file ? "none" : file.error().message();
}

TEST(AtomicFile, RefusesWhatCannotBeAFile) {
  const fs::path folder = test::testFolder();
  EXPECT_THAT(refusal(folder / std::string(300, 'a')), HasSubstr("File name too long"));
  EXPECT_THAT(refusal("/" + std::string(5000, 'a')), HasSubstr("File name too long"));
  EXPECT_THAT(refusal(folder / ""), HasSubstr("the output is a folder"));
  EXPECT_THAT(refusal(""), HasSubstr("the output is a folder"));
  fs::create_symlink("ring", folder / "ring");
  EXPECT_THAT(refusal(folder / "ring"), HasSubstr("symbolic links"));
  EXPECT_EQ(filesIn(folder), 1u);
}

TEST(AtomicFile, TakesTheLongestNames) {
  const fs::path target = test::testFolder() / std::string(255, 'a');
  requireDone(writeWholeFile(target, "text"));
  EXPECT_EQ(readText(target), "text");
}

TEST(AtomicFile, RefusesSockets) {
  const fs::path folder = test::testFolder();
  sockaddr_un address{AF_UNIX, "socket"};
  const int server = socket(AF_UNIX, SOCK_STREAM, 0);
  const fs::path before = fs::current_path();
  fs::current_path(folder);  // the address holds 108 bytes
  ASSERT_EQ(bind(server, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  fs::current_path(before);
  close(server);
  EXPECT_THAT(refusal(folder / "socket"), HasSubstr("the output is a socket"));
  EXPECT_TRUE(fs::is_socket(folder / "socket"));
}

// Root may everything, so it becomes somebody else.
TEST(AtomicFileDeathTest, RefusesWhatMayNotBeWrittenOrSearched) {
  const fs::path folder = test::testFolder();
  write(folder / "locked.txt", "old");
  fs::permissions(folder / "locked.txt", fs::perms::owner_read);
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::none);
  const auto asAnother = [&] {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setuid(kNobody) != 0) _exit(1);
    for (const fs::path& target : {folder / "locked.txt", folder / "closed" / "out.txt"})
      if (!refusal(target).ends_with("Permission denied")) _exit(2);
    _exit(7);
  };
  EXPECT_EXIT(asAnother(), testing::ExitedWithCode(7), "");
  fs::permissions(folder / "closed", fs::perms::owner_all);
}

TEST(AtomicFile, FollowsSymbolicLinks) {
  const fs::path folder = test::testFolder();
  fs::create_directory(folder / "far");
  fs::create_symlink("far/out.txt", folder / "relative");
  fs::create_symlink(folder / "relative", folder / "absolute");
  for (const char* text : {"first", "second"}) {  // what the links name is not there at first
    requireDone(writeWholeFile(folder / "absolute", text));
    EXPECT_EQ(readText(folder / "far" / "out.txt"), text);
  }
  EXPECT_TRUE(fs::is_symlink(folder / "absolute") && fs::is_symlink(folder / "relative"));
  EXPECT_EQ(filesIn(folder / "far"), 1u);
}

TEST(AtomicFile, KeepsTheModeOfWhatItReplaces) {
  const fs::path target = test::testFolder() / "out.txt";
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    write(target, "old");
    ASSERT_EQ(chmod(target.c_str(), mode), 0);
    AtomicFile file = valueOf(AtomicFile::create(target));
    struct stat status {};
    ASSERT_EQ(stat(file.temporary().c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 077 & ~mode, 0u) << "nobody else reads the temporary";
    write(file.temporary(), "new");
    requireDone(file.commit());
    ASSERT_EQ(stat(target.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, mode);
  }
}

TEST(AtomicFile, ANewFileHasTheModeThatTheUmaskLeaves) {
  const fs::path target = test::testFolder() / "out.txt";
  const mode_t before = umask(027);
  const Result<void> written = writeWholeFile(target, "text");
  umask(before);
  requireDone(written);
  struct stat status {};
  ASSERT_EQ(stat(target.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640u);
}

TEST(AtomicFile, WritesThroughPipes) {
  const fs::path pipe = test::testFolder() / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = readText(pipe); });
  const std::string text(300000, 'x');  // more than a pipe holds
  const Result<void> written = writeWholeFile(pipe, text);
  reader.join();
  requireDone(written);
  EXPECT_TRUE(read == text);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(filesIn(pipe.parent_path()), 1u);
}

TEST(AtomicFile, WritesThroughDevices) {
  requireDone(writeWholeFile("/dev/null", "text"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  EXPECT_THAT(writeWholeFile("/dev/full", "text").error().message(), HasSubstr("No space left"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// As `>> log` and `>(jq)` of a shell ask for.
TEST(AtomicFile, WritesIntoOpenDescriptors) {
  const fs::path log = test::testFolder() / "log";
  write(log, "before ");
  const int descriptor = open(log.c_str(), O_WRONLY | O_APPEND);
  const Result<void> written = writeWholeFile("/dev/fd/" + std::to_string(descriptor), "after");
  close(descriptor);
  requireDone(written);
  EXPECT_EQ(readText(log), "before after");
  EXPECT_THAT(refusal("/dev/fd/" + std::to_string(descriptor)), HasSubstr("not open for writing"));
}

/// The end of a process that is killed while it writes.
void writeUntilKilled(const fs::path& target) {
  if (const pid_t process = fork(); process > 0) {
    int status = 0;
    waitpid(process, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    return;
  }
  auto file = AtomicFile::create(target);
  write(file->temporary(), "half");
  write(file->temporary().string() + ".XyZ", "a library's own temporary");
  raise(SIGKILL);
}

TEST(AtomicFile, SweepsWhatAKilledProcessLeft) {
  const fs::path folder = test::testFolder();
  writeUntilKilled(folder / "out.txt");
  EXPECT_EQ(filesIn(folder), 3u);
  write(folder / ".weft-1-0@another.lock", "");
  write(folder / ".weft-1-0@another.part", "of another host");
  write(folder / "other.part", "no temporary of ours");
  requireDone(writeWholeFile(folder / "other.txt", "text"));
  EXPECT_EQ(filesIn(folder), 4u);
}

TEST(AtomicFile, LeavesAloneWhatAnotherProcessIsWriting) {
  const fs::path folder = test::testFolder();
  AtomicFile file = valueOf(AtomicFile::create(folder / "out.txt"));
  write(file.temporary(), "half");
  const pid_t process = fork();
  if (process == 0) {
    // A lock that was inherited would be no other process's.
    for (int descriptor = 3; descriptor < 100; ++descriptor) close(descriptor);
    LockedTemporary::sweep(folder);
    _exit(fs::exists(file.temporary()) ? 7 : 1);
  }
  int status = 0;
  waitpid(process, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  requireDone(file.commit());
  EXPECT_EQ(filesIn(folder), 1u);
}

}  // namespace
}  // namespace weft
