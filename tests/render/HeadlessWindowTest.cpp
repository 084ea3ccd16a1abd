#include "weft/scenegraph/HeadlessWindow.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "GlTest.h"

namespace weft {
namespace {

class HeadlessWindowTest : public test::GlTest {};

TEST_F(HeadlessWindowTest, TestsDrawWithLlvmpipe) {
  if (!std::getenv("LIBGL_ALWAYS_SOFTWARE")) GTEST_SKIP() << "ctest sets LIBGL_ALWAYS_SOFTWARE";
  EXPECT_THAT(reinterpret_cast<const char*>(glGetString(GL_RENDERER)), testing::HasSubstr("llvmpipe"));
}

}  // namespace
}  // namespace weft
