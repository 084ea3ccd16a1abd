#include "weft/chunks/ProgramChunk.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/materials/ChunkMaterial.h"

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

}  // namespace
}  // namespace weft
