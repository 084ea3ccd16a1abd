#include "weft/core/FileLock.h"

#include <gmock/gmock.h>

#include <fstream>

#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

TEST(FileLock, HasOneOwnerAndGoesWithIt) {
  const fs::path file = test::testFolder() / "lock";
  {
    auto first = test::valueOf(FileLock::tryAcquire(file));
    ASSERT_TRUE(first);
    EXPECT_FALSE(test::valueOf(FileLock::tryAcquire(file)));
    const FileLock moved(std::move(*first));
    first.reset();
    EXPECT_FALSE(test::valueOf(FileLock::tryAcquire(file)));
    EXPECT_TRUE(fs::exists(file));
  }
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(test::valueOf(FileLock::tryAcquire(file)));
}

TEST(FileLock, IsFreeWhereItsOwnerWasKilled) {
  const fs::path file = test::testFolder() / "lock";
  std::ofstream(file) << "";
  EXPECT_TRUE(test::valueOf(FileLock::tryAcquire(file)));
}

TEST(FileLock, SaysWhereItCannotBe) {
  const auto lock = FileLock::tryAcquire(test::testFolder() / "missing" / "lock");
  ASSERT_FALSE(lock);
  EXPECT_THAT(lock.error().message(), testing::HasSubstr("missing"));
}

}  // namespace
}  // namespace weft
