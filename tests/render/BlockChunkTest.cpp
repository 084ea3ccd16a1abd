#include <epoxy/gl.h>

#include <array>

#include "GlTest.h"
#include "weft/chunks/StorageBlockChunk.h"
#include "weft/chunks/UniformBlockChunk.h"

namespace weft {
namespace {

using Numbers = std::array<float, 4>;

class BlockChunkTest : public test::GlTest {
 protected:
  /// The buffer that the chunk binds, 0 for none.
  GLuint bound(const BlockChunk& chunk) {
    chunk.activate(context(), chunk.kind() + 3);
    GLint buffer = 0;
    glGetIntegeri_v(
        chunk.kind() == UniformSlot ? GL_UNIFORM_BUFFER_BINDING : GL_SHADER_STORAGE_BUFFER_BINDING, 3,
        &buffer);
    chunk.deactivate(context(), chunk.kind() + 3);
    return static_cast<GLuint>(buffer);
  }

  template <class Kind>
  void expectRefreshedOrRemade() {
    Kind chunk(blockBytes(Numbers{1, 2, 3, 4}));
    const GLuint first = bound(chunk);
    chunk.set(blockBytes(Numbers{5, 6, 7, 8}));
    EXPECT_EQ(bound(chunk), first) << "the same size is refreshed";
    Numbers read{};
    glGetNamedBufferSubData(first, 0, sizeof read, read.data());
    EXPECT_EQ(read, (Numbers{5, 6, 7, 8}));

    const std::array<Numbers, 2> larger{Numbers{1, 1, 1, 1}, Numbers{2, 2, 2, 2}};
    chunk.set(blockBytes(larger));
    const GLuint second = bound(chunk);
    GLint size = 0;
    glGetNamedBufferParameteriv(second, GL_BUFFER_SIZE, &size);
    EXPECT_EQ(size, 32) << "another size is remade";
    chunk.set({});
    EXPECT_EQ(bound(chunk), 0u);
  }
};

TEST_F(BlockChunkTest, TheSameSizeIsRefreshedAndAnotherRemade) {
  expectRefreshedOrRemade<UniformBlockChunk>();
  expectRefreshedOrRemade<StorageBlockChunk>();
}

TEST_F(BlockChunkTest, EqualBytesAreEqualState) {
  const UniformBlockChunk a(blockBytes(Numbers{1, 2, 3, 4})), b(blockBytes(Numbers{1, 2, 3, 4}));
  const UniformBlockChunk c(blockBytes(Numbers{1, 2, 3, 5}));
  EXPECT_TRUE(a == b);
  EXPECT_FALSE(a == c);
  EXPECT_FALSE(a == StorageBlockChunk(blockBytes(Numbers{1, 2, 3, 4})));
}

TEST_F(BlockChunkTest, MoreThanTheGLAllowsIsReported) {
  const auto limit = static_cast<std::size_t>(context().limits().uniformBlockBytes);
  EXPECT_EQ(bound(UniformBlockChunk(std::vector<std::byte>(limit + 16))), 0u);
  const auto error = context().takeErrors();
  ASSERT_FALSE(error);
  EXPECT_NE(error.error().what.find(std::to_string(limit + 16)), std::string::npos);
}

}  // namespace
}  // namespace weft
