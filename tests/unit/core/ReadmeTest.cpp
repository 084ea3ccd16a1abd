#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "TestSupport.h"

namespace weft {
namespace {

std::string textOf(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, QuotesTheSampleThatIsTested) {
  const std::string sample = textOf(test::sourceFolder() / "samples/offscreen.cpp");
  ASSERT_FALSE(sample.empty());
  EXPECT_THAT(textOf(test::sourceFolder() / "README.md"), testing::HasSubstr("```cpp\n" + sample + "```\n"));
}

}  // namespace
}  // namespace weft
