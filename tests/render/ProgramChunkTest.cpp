#include "weft/chunks/ProgramChunk.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/materials/ChunkMaterial.h"
#include "weft/materials/LambertMaterial.h"

namespace weft {
namespace {

using test::writeText;
using testing::HasSubstr;

class ProgramChunkTest : public test::GlTest {
 protected:
  std::shared_ptr<const ProgramChunk> program(std::string_view fragment) {
    writeText(folder / "test.frag", fragment);
    return std::make_shared<ProgramChunk>(ShaderSource{"mesh.vert", "test.frag", {}, {}, folder});
  }

  Error errorOf(const ProgramChunk& chunk) {
    chunk.activate(context(), ProgramSlot);
    GLint current = 0;
    glGetIntegerv(GL_CURRENT_PROGRAM, &current);
    EXPECT_EQ(current, 0);
    const auto result = context().takeErrors();
    EXPECT_FALSE(result);
    return result ? Error{} : result.error();
  }

  std::filesystem::path folder = test::testFolder();
};

TEST_F(ProgramChunkTest, CompileErrorNamesFileAndLine) {
  const Error error = errorOf(*program("#version 450 core\n\nvoid main() { nonsense(); }\n"));
  EXPECT_EQ(error.where, "test.frag:3");
  EXPECT_THAT(error.what, HasSubstr("nonsense"));
}

TEST_F(ProgramChunkTest, CompileErrorInAnIncludeNamesTheInclude) {
  writeText(folder / "part.glsl", "float two() {\n  return 2.0;\n}\nfloat bad = twice(1.0);\n");
  const auto chunk = program("#version 450 core\n#include \"part.glsl\"\nvoid main() {}\n");
  EXPECT_EQ(errorOf(*chunk).where, "part.glsl:4");
}

TEST_F(ProgramChunkTest, LinkErrorNamesTheStages) {
  const Error error =
      errorOf(*program("#version 450 core\nin vec3 notGiven;\nout vec4 color;\n"
                       "void main() { color = vec4(notGiven, 1.0); }\n"));
  EXPECT_EQ(error.where, "mesh.vert and test.frag");
  EXPECT_THAT(error.what, HasSubstr("notGiven"));
}

TEST_F(ProgramChunkTest, MissingFileIsReported) {
  EXPECT_THAT(errorOf(ProgramChunk({"mesh.vert", "none.frag"})).what, HasSubstr("none.frag"));
}

TEST_F(ProgramChunkTest, BrokenShaderFailsEveryRenderAndIsCompiledOnce) {
  auto material = std::make_shared<ChunkMaterial>();
  material->setChunk(ProgramSlot, program("#version 450 core\nbroken\n"));
  const auto root = test::dressed(material);
  const RenderTarget target(4, 4);
  for (int frame = 0; frame < 2; ++frame) {
    const auto rendered = renderer.render(context(), *root, test::squareCamera(), target);
    ASSERT_FALSE(rendered);
    EXPECT_THAT(rendered.error().where, HasSubstr("test.frag:2"));
    writeText(folder / "test.frag", "would name another line\n");
  }
}

TEST_F(ProgramChunkTest, DefinesReachBothStages) {
  writeText(folder / "test.vert", "#version 450 core\nvoid main() { gl_Position = vec4(VALUE); }\n");
  writeText(folder / "test.frag", "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(VALUE); }\n");
  const ProgramChunk chunk({"test.vert", "test.frag", {{"VALUE", "0.5"}}, {}, folder});
  chunk.activate(context(), ProgramSlot);
  EXPECT_TRUE(context().takeErrors());
  chunk.deactivate(context(), ProgramSlot);
}

/// A square in one colour, which is written into a file again and again.
class ReloadTest : public ProgramChunkTest {
 protected:
  void write(const std::string& color) {
    writeText(folder / "color.glsl", "const vec4 shown = vec4(" + color + ");\n");
  }
  float shown() { return picture(*root).at(4, 4, 0); }

  static constexpr std::string_view kFragment =
      "#version 450 core\n#include \"color.glsl\"\nout vec4 color;\nvoid main() { color = shown; }\n";
  std::shared_ptr<Node> root;

  void SetUp() override {
    ProgramChunkTest::SetUp();
    write("0.25");
    auto material = std::make_shared<ChunkMaterial>();
    material->setChunk(ProgramSlot, program(kFragment));
    root = test::dressed(material);
  }
};

TEST_F(ReloadTest, ShowsWhatAnIncludeSaysNow) {
  EXPECT_EQ(shown(), 0.25f);
  EXPECT_FALSE(test::valueOf(reloadPrograms(context())));
  write("0.5");
  EXPECT_EQ(shown(), 0.25f) << "nothing changes unasked";
  EXPECT_TRUE(test::valueOf(reloadPrograms(context())));
  EXPECT_EQ(shown(), 0.5f);
  EXPECT_FALSE(test::valueOf(reloadPrograms(context())));
}

TEST_F(ReloadTest, KeepsTheOldProgramWhereTheNewOneIsInError) {
  EXPECT_EQ(shown(), 0.25f);
  write("nonsense");
  for (int i = 0; i < 2; ++i) {
    const auto reloaded = reloadPrograms(context());
    ASSERT_FALSE(reloaded);
    EXPECT_EQ(reloaded.error().where, "color.glsl:1");
    EXPECT_THAT(reloaded.error().what, HasSubstr("nonsense"));
    EXPECT_EQ(shown(), 0.25f);
  }
  std::filesystem::remove(folder / "color.glsl");
  const auto reloaded = reloadPrograms(context());
  ASSERT_FALSE(reloaded);
  EXPECT_EQ(reloaded.error().where, "test.frag:2");
  EXPECT_EQ(shown(), 0.25f);
  write("0.75");
  EXPECT_TRUE(test::valueOf(reloadPrograms(context())));
  EXPECT_EQ(shown(), 0.75f);
}

TEST_F(ReloadTest, MendsAProgramThatWasBrokenFromTheStart) {
  write("nonsense");
  const RenderTarget target(4, 4);
  ASSERT_FALSE(renderer.render(context(), *root, test::squareCamera(), target));
  write("1.0");
  EXPECT_TRUE(test::valueOf(reloadPrograms(context())));
  EXPECT_EQ(shown(), 1.0f);
}

TEST_F(ReloadTest, OneBrokenProgramDoesNotKeepTheOthersFromChanging) {
  writeText(folder / "other.frag", kFragment);
  auto other = std::make_shared<ChunkMaterial>();
  other->setChunk(ProgramSlot,
                  std::make_shared<ProgramChunk>(ShaderSource{"mesh.vert", "other.frag", {}, {}, folder}));
  const auto otherRoot = test::dressed(other);
  EXPECT_EQ(shown() + picture(*otherRoot).at(4, 4, 0), 0.5f);
  for (const char* broken : {"test.frag", "other.frag"}) {
    writeText(folder / "test.frag", kFragment);
    writeText(folder / "other.frag", kFragment);
    writeText(folder / broken, "#version 450 core\nbroken\n");
    write(broken == std::string("test.frag") ? "0.5" : "0.75");
    const auto reloaded = reloadPrograms(context());
    ASSERT_FALSE(reloaded);
    EXPECT_THAT(reloaded.error().where, HasSubstr(broken));
  }
  EXPECT_EQ(shown(), 0.75f);
  EXPECT_EQ(picture(*otherRoot).at(4, 4, 0), 0.5f);
}

TEST_F(ReloadTest, TheContextsFolderIsForEveryProgram) {
  context().setShaderFolder(folder);
  writeText(folder / "lambert.frag", kFragment);
  const auto matt = test::dressed(std::make_shared<LambertMaterial>());
  EXPECT_EQ(picture(*matt).at(4, 4, 0), 0.25f);
  write("0.5");
  EXPECT_TRUE(test::valueOf(reloadPrograms(context())));
  EXPECT_EQ(picture(*matt).at(4, 4, 0), 0.5f);
}

}  // namespace
}  // namespace weft
