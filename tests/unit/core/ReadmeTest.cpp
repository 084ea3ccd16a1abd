#include <gmock/gmock.h>

#include "TestSupport.h"
#include "TextFile.h"

namespace weft {
namespace {

using test::readText;

TEST(Readme, QuotesTheSampleThatIsTested) {
  const std::string sample = readText(test::sourceFolder() / "samples/offscreen.cpp");
  ASSERT_FALSE(sample.empty());
  EXPECT_THAT(readText(test::sourceFolder() / "README.md"),
              testing::HasSubstr("```cpp\n" + sample + "```\n"));
}

}  // namespace
}  // namespace weft
