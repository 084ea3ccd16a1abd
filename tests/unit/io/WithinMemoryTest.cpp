#include "weft/io/WithinMemory.h"

#include <gtest/gtest.h>

#include "TestSupport.h"

namespace weft {
namespace {

TEST(WithinMemory, SaysThatMemoryRanOut) {
  const auto failed = withinMemory("a.png", []() -> Result<int> { throw std::bad_alloc(); });
  EXPECT_EQ(failed.error().message(), "a.png: there is not enough memory to read it");
  EXPECT_EQ(test::valueOf(withinMemory("a.png", []() -> Result<int> { return 7; })), 7);
}

}  // namespace
}  // namespace weft
