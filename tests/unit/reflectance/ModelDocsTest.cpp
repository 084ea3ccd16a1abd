#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "TestSupport.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {
namespace {

// docs/models.md: a row a declared option, the models that declare the same together.
TEST(ModelDocs, TheTableOfOptionsIsWhatTheModelsDeclare) {
  std::ostringstream page;
  page << std::ifstream(test::sourceFolder() / "docs/models.md").rdbuf();
  const ModelRegistry registry = ModelRegistry::builtin();
  for (const ModelType& type : registry.types()) {
    EXPECT_THAT(page.str(), testing::HasSubstr("`" + type.name + "`"));
    for (const ModelOption& option : type.options) {
      std::vector<std::string> models;
      for (const ModelType& other : registry.types())
        for (const ModelOption& same : other.options)
          if (same.name == option.name && same.range() == option.range()) models.push_back(other.name);
      EXPECT_THAT(page.str(), testing::HasSubstr(fmt::format("| `{}` | `{}` | {} | {} |\n", option.name,
                                                             fmt::join(models, "`, `"), option.range(),
                                                             textOf(option.standard))));
    }
  }
}

}  // namespace
}  // namespace weft
