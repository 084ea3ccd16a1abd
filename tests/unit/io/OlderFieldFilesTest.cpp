#include <gmock/gmock.h>

#include <set>

#include "OlderFields.h"
#include "weft/core/Direction.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft {
namespace {

using test::valueOf;

TEST(OlderFieldFiles, HoldEveryModelOfTheirTime) {
  std::set<std::string> models;
  for (const std::string& name : test::olderFields())
    models.insert(valueOf(readReflectanceField(test::olderFieldsFolder() / (name + ".rf.exr"),
                                               ModelRegistry::builtin()))
                      .model()
                      .description()
                      .name);
  EXPECT_THAT(models, testing::ElementsAre("bump", "laf", "lfnl", "lfp", "ptm", "rfnl", "rfp", "slaf"));
}

class OlderFieldFile : public testing::TestWithParam<std::string> {};

TEST_P(OlderFieldFile, GivesTheValuesThatItGaveWhenItWasWritten) {
  const std::filesystem::path folder = test::olderFieldsFolder();
  const ReflectanceField field =
      valueOf(readReflectanceField(folder / (GetParam() + ".rf.exr"), ModelRegistry::builtin()));
  const FloatImage values = valueOf(readExr(folder / (GetParam() + ".values.exr")));  // B, G, R
  ASSERT_EQ(values.width(), field.width());
  ASSERT_EQ(values.height(), field.height());
  const glm::vec3 view = directionFromDegrees(40, 50), light = directionFromDegrees(35, 200);
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x) {
      const glm::vec3 value = field.evaluate(x, y, light, view);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], values.at(x, y, 2 - c), 1e-6) << x << ", " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Manifest2, OlderFieldFile, testing::ValuesIn(test::olderFields()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace weft
