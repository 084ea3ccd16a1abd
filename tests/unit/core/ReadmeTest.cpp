#include <gmock/gmock.h>

#include <regex>

#include "TestSupport.h"
#include "TextFile.h"

namespace weft {
namespace {

using test::readText;

// The blocks of C++ in a page.
std::vector<std::string> codeOf(const std::string& page) {
  static const std::regex block("```cpp\n([^`]+)```\n");
  const std::string text = readText(test::sourceFolder() / page);
  std::vector<std::string> blocks;
  for (std::sregex_iterator at(text.begin(), text.end(), block), end; at != end; ++at)
    blocks.push_back((*at)[1]);
  return blocks;
}

TEST(Readme, AndStartPagesQuoteTheSamplesThatAreTested) {
  const std::map<std::string, std::string> samples{{"README.md", "samples/offscreen.cpp"},
                                                   {"docs/your-program.md", "samples/moving-light.cpp"},
                                                   {"docs/your-model.md", "samples/own-model.cpp"}};
  for (const auto& [page, file] : samples) {
    const std::vector<std::string> blocks = codeOf(page);
    EXPECT_EQ(blocks.size(), 1u) << page;
    const std::string sample = readText(test::sourceFolder() / file);
    for (const std::string& block : blocks) EXPECT_THAT(sample, testing::HasSubstr(block)) << page;
  }
}

}  // namespace
}  // namespace weft
