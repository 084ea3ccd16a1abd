#include "weft/chunks/ShaderSource.h"

#include <gmock/gmock.h>

#include "TestScene.h"
#include "TestSupport.h"

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

TEST_F(ShaderSourceTest, PutsEachIncludeInOnceAndKeepsLineNumbers) {
  writeText(folder / "a.frag",
            "// first\n#version 450 core\n#include \"b.glsl\"\n#include \"c.glsl\"\nend\n");
  writeText(folder / "b.glsl", "#include \"c.glsl\"\nb\n");
  writeText(folder / "c.glsl", "c\n");
  source.defines = {{"COUNT", "3"}};
  const ShaderText shader = valueOf(assembleShader(source, "a.frag"));
  EXPECT_EQ(shader.text,
            "// first\n#version 450 core\n#define COUNT 3\n#line 3 0\n"
            "#line 1 1\n#line 1 2\nc\n#line 2 1\nb\n#line 4 0\n#line 5 0\nend\n");
  EXPECT_EQ(shader.files, (std::vector<std::string>{"a.frag", "b.glsl", "c.glsl"}));
}

TEST_F(ShaderSourceTest, AliasesNameTheFileToInclude) {
  writeText(folder / "a.frag", "#include \"model.glsl\"\n");
  writeText(folder / "rfnl.glsl", "lobes\n");
  source.includeAliases = {{"model.glsl", "rfnl.glsl"}};
  const ShaderText shader = valueOf(assembleShader(source, "a.frag"));
  EXPECT_THAT(shader.text, HasSubstr("lobes"));
  EXPECT_EQ(shader.files.back(), "rfnl.glsl");
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

TEST_F(ShaderSourceTest, EveryDriversMessagesGetFileNames) {
  const ShaderText shader{"", {"a.frag", "b.glsl"}};
  const auto named = [&](std::string_view log) {
    std::string place;
    const std::string text = shader.withFileNames(log, place);
    return place + "|" + text;
  };
  EXPECT_EQ(named("1:12(5): error: x\n0:3(1): error: y\n"),
            "b.glsl:12|b.glsl:12(5): error: x\na.frag:3(1): error: y");
  EXPECT_EQ(named("1(12) : error C1: x"), "b.glsl:12|b.glsl(12) : error C1: x");
  EXPECT_EQ(named("ERROR: 1:12: 'x'"), "b.glsl:12|b.glsl:12: 'x'");
  EXPECT_EQ(named("7:12(5): no such file"), "|7:12(5): no such file");
  EXPECT_EQ(named("linking failed"), "|linking failed");
}

}  // namespace
}  // namespace weft
