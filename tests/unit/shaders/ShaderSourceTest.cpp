#include "weft/shaders/ShaderSource.h"

#include <gmock/gmock.h>

#include "TestSupport.h"
#include "TextFile.h"

namespace weft {
namespace {

using test::valueOf;
using test::writeText;
using testing::HasSubstr;
using testing::Not;

class ShaderSourceTest : public testing::Test {
 protected:
  void SetUp() override { source.overrideFolder = folder; }

  std::filesystem::path folder = test::testFolder();
  ShaderSource source;
};

TEST_F(ShaderSourceTest, PutsEachIncludeInOnceAndKnowsWhereLinesCameFrom) {
  writeText(folder / "a.frag",
            "// first\n#version 450 core\n#include \"b.glsl\"\n#include \"c.glsl\"\nend\n");
  writeText(folder / "b.glsl", "#include \"c.glsl\"\nb\n");
  writeText(folder / "c.glsl", "c\n");
  source.defines = {{"COUNT", "3"}};
  const ShaderText shader = valueOf(assembleShader(source, "a.frag"));
  EXPECT_EQ(shader.text, "// first\n#version 450 core\n#define COUNT 3\nc\nb\nend\n");
  EXPECT_EQ(shader.places, (std::vector<std::string>{"a.frag:1", "a.frag:2", "the define COUNT", "c.glsl:1",
                                                     "b.glsl:2", "a.frag:5"}));
}

TEST_F(ShaderSourceTest, AliasesNameTheFileToInclude) {
  writeText(folder / "a.frag", "#include \"model.glsl\"\n");
  writeText(folder / "rfnl.glsl", "lobes\n");
  source.includeAliases = {{"model.glsl", "rfnl.glsl"}};
  const ShaderText shader = valueOf(assembleShader(source, "a.frag"));
  EXPECT_THAT(shader.text, HasSubstr("lobes"));
  EXPECT_EQ(shader.places.back(), "rfnl.glsl:1");
}

TEST_F(ShaderSourceTest, FilesOfTheOverrideFolderWinOverThoseCompiledIn) {
  EXPECT_THAT(valueOf(assembleShader(source, "lights.glsl")).text, HasSubstr("lightAt"));
  writeText(folder / "lights.glsl", "dark\n");
  EXPECT_EQ(valueOf(assembleShader(source, "lights.glsl")).text, "dark\n");
}

TEST_F(ShaderSourceTest, MissingAndMalformedIncludesNameFileAndLine) {
  writeText(folder / "a.frag", "\n#include \"missing.glsl\"\n");
  const auto missing = assembleShader(source, "a.frag");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().where, "a.frag:2");
  EXPECT_THAT(missing.error().what, HasSubstr("missing.glsl"));

  writeText(folder / "a.frag", "#include <b.glsl>\n");
  const auto malformed = assembleShader(source, "a.frag");
  ASSERT_FALSE(malformed);
  EXPECT_EQ(malformed.error().where, "a.frag:1");
  writeText(folder / "a.frag", "#include \"b.glsl\n");
  EXPECT_FALSE(assembleShader(source, "a.frag"));
}

TEST_F(ShaderSourceTest, EveryDriversMessagesGetPlaces) {
  const ShaderText shader{"", {"a.frag:1", "b.glsl:7"}};
  const auto placed = [&](std::string_view log) {
    std::string first;
    const std::string text = shader.withPlaces(log, first);
    return first + "|" + text;
  };
  EXPECT_EQ(placed("0:2(5): error: x\n0:1(1): error: y\n"),
            "b.glsl:7|b.glsl:7(5): error: x\na.frag:1(1): error: y");
  EXPECT_EQ(placed("0(2) : error C1: x"), "b.glsl:7|b.glsl:7 : error C1: x");
  EXPECT_EQ(placed("ERROR: 0:2: 'x'"), "b.glsl:7|b.glsl:7: 'x'");
  EXPECT_EQ(placed("0:12(5): no such line"), "|0:12(5): no such line");
  EXPECT_EQ(placed("linking failed"), "|linking failed");
}

}  // namespace
}  // namespace weft
