#include "weft/tool/ThreadCheck.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "TestSupport.h"

namespace weft {
namespace {

TEST(ThreadCheck, ThreadsCanBeHad) {
  test::requireDone(checkThreads(8));
}

/// What this process may take as memory becomes what it has and so many bytes more.
void leaveOnly(std::uint64_t bytes) {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t limit = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit memory{limit, limit};
  setrlimit(RLIMIT_AS, &memory);
}

TEST(ThreadCheckDeathTest, ThreadsThatCannotBeHadAreSaid) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto crowded = [] {
    leaveOnly(64u << 20);  // a thread's stack takes 8 MiB of it
    const Result<void> checked = checkThreads(100);
    _exit(!checked && checked.error().what.starts_with("only ") ? 7 : 1);
  };
  EXPECT_EXIT(crowded(), testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace weft
