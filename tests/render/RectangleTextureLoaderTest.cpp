#include "weft/scene_io/RectangleTextureLoader.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/io/ExrFile.h"

namespace weft {
namespace {

using testing::HasSubstr;

/// Values that no two texels or channels share, exact in half precision.
FloatImage numbered(std::vector<std::string> channels, Precision precision) {
  FloatImage image(5, 3, std::move(channels));
  float value = 0.0f;
  for (float& v : image.values()) v = value += 0.125f;
  if (precision == Precision::Half) image.roundToHalf();
  return image;
}

class RectangleTextureLoader : public test::GlTest {};

TEST_F(RectangleTextureLoader, BringsAFileToTheGpuUnchanged) {
  for (const Precision precision : {Precision::Half, Precision::Float}) {
    const auto path = test::testFolder() / "parameters.exr";
    const FloatImage image = numbered({"R", "G", "B", "other"}, precision);
    test::requireDone(writeExr(path, image));
    const auto chunk = test::valueOf(loadRectangleTexture(path, {"B", "other", "R"}));

    chunk->activate(context(), textureSlot(0));
    GLint texture = 0, format = 0;
    glActiveTexture(GL_TEXTURE0);
    glGetIntegerv(GL_TEXTURE_BINDING_RECTANGLE, &texture);
    ASSERT_NE(texture, 0);
    glGetTextureLevelParameteriv(static_cast<GLuint>(texture), 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    EXPECT_EQ(format, precision == Precision::Half ? GL_RGB16F : GL_RGB32F);
    std::vector<float> texels(5 * 3 * 3);
    glGetTextureImage(static_cast<GLuint>(texture), 0, GL_RGB, GL_FLOAT,
                      static_cast<GLsizei>(texels.size() * sizeof(float)), texels.data());
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 5; ++x) {
        const float* texel = texels.data() + (y * 5 + x) * 3;
        EXPECT_EQ(texel[0], image.at(x, y, 2));
        EXPECT_EQ(texel[1], image.at(x, y, 3));
        EXPECT_EQ(texel[2], image.at(x, y, 0));
      }
    chunk->deactivate(context(), textureSlot(0));
  }
}

TEST_F(RectangleTextureLoader, NamesWhatIsMissing) {
  const auto path = test::testFolder() / "parameters.exr";
  const auto none = loadRectangleTexture(path);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message(), HasSubstr("parameters.exr"));
  test::requireDone(writeExr(path, numbered({"R", "G"}, Precision::Float)));
  const auto noBlue = loadRectangleTexture(path);
  ASSERT_FALSE(noBlue);
  EXPECT_THAT(noBlue.error().message(), testing::AllOf(HasSubstr("parameters.exr"), HasSubstr("\"B\"")));
}

}  // namespace
}  // namespace weft
