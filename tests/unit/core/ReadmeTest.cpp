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

TEST(Readme, QuotesTheEmbeddingExampleThatIsTested) {
  const std::string example = textOf(test::sourceFolder() / "docs/examples/embedding.cpp");
  ASSERT_FALSE(example.empty());
  EXPECT_THAT(textOf(test::sourceFolder() / "README.md"), testing::HasSubstr("```cpp\n" + example + "```\n"));
}

}  // namespace
}  // namespace weft
