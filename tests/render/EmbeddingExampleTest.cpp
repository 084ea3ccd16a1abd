// The example that the README quotes, compiled and run.
#include "../../docs/examples/embedding.cpp"

#include "GlTest.h"
#include "TestField.h"
#include "TestSupport.h"

namespace weft {
namespace {

class EmbeddingExample : public test::GlTest {};

TEST_F(EmbeddingExample, DrawsACloth) {
  const auto file = test::testFolder() / "test.rf.exr";
  test::requireDone(writeReflectanceField(test::testField(), file));
  const RenderTarget target(80, 60);
  test::requireDone(drawCloth(context(), target, file.c_str()));
  const FloatImage picture = target.read(context());
  EXPECT_GT(picture.at(40, 30, 0), 0.02f);
  EXPECT_EQ(picture.at(0, 0, 0), 0.0f);
}

}  // namespace
}  // namespace weft
