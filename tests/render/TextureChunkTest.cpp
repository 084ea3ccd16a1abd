#include "weft/chunks/TextureChunk.h"

#include <epoxy/gl.h>

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/CubeTextureChunk.h"

namespace weft {
namespace {

constexpr unsigned kUnit = 2;
const std::vector<std::string> kNames{"a", "b", "c", "d"};

std::vector<std::string> channels(int count) {
  return {kNames.begin(), kNames.begin() + count};
}

/// Values of all magnitudes, tiny and negative ones among them.
std::shared_ptr<FloatImage> values(int width, int height, int channelCount, int layers, Precision precision) {
  auto image = std::make_shared<FloatImage>(width, height, channels(channelCount), layers);
  int i = 0;
  for (float& value : image->values()) {
    value =
        std::ldexp(1.0f + static_cast<float>(i % 977) / 1000.0f, i % 38 - 24) * (i % 3 == 0 ? -1.0f : 1.0f);
    ++i;
  }
  if (precision == Precision::Half) image->roundToHalf();
  return image;
}

/// What is bound to a target of the unit, 0 for nothing.
GLuint bound(GLenum binding) {
  GLint texture = 0;
  glActiveTexture(GL_TEXTURE0 + kUnit);
  glGetIntegerv(binding, &texture);
  glActiveTexture(GL_TEXTURE0);
  return static_cast<GLuint>(texture);
}

GLint levelParameter(GLuint texture, GLenum parameter) {
  GLint value = 0;
  glGetTextureLevelParameteriv(texture, 0, parameter, &value);
  return value;
}

template <class Value>
std::vector<Value> readBack(GLuint texture, int channelCount, GLenum type, std::size_t count) {
  constexpr GLenum kChannels[] = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
  std::vector<Value> texels(count);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(texture, 0, kChannels[channelCount - 1], type,
                    static_cast<GLsizei>(count * sizeof(Value)), texels.data());
  return texels;
}

struct ShapeCase {
  TextureShape shape;
  GLenum binding;
  int width, height, layers;
};
constexpr ShapeCase kShapes[] = {{TextureShape::TwoDimensional, GL_TEXTURE_BINDING_2D, 7, 5, 1},
                                 {TextureShape::Array, GL_TEXTURE_BINDING_2D_ARRAY, 7, 5, 3},
                                 {TextureShape::Rectangle, GL_TEXTURE_BINDING_RECTANGLE, 7, 5, 1},
                                 {TextureShape::ThreeDimensional, GL_TEXTURE_BINDING_3D, 7, 5, 3},
                                 {TextureShape::Cube, GL_TEXTURE_BINDING_CUBE_MAP, 5, 5, 6}};

class TextureChunkTest : public test::GlTest {
 protected:
  void activate(const TextureChunk& chunk) { chunk.activate(context(), textureSlot(kUnit)); }
};

TEST_F(TextureChunkTest, FloatFormatsAreSizedAndComeBackExactly) {
  constexpr GLint kHalf[] = {GL_R16F, GL_RG16F, GL_RGB16F, GL_RGBA16F};
  constexpr GLint kSingle[] = {GL_R32F, GL_RG32F, GL_RGB32F, GL_RGBA32F};
  for (const ShapeCase& shape : kShapes)
    for (const Precision precision : {Precision::Half, Precision::Float})
      for (int channelCount = 1; channelCount <= 4; ++channelCount) {
        SCOPED_TRACE(testing::Message() << "shape " << int(shape.shape) << ", channels " << channelCount);
        const auto image = values(shape.width, shape.height, channelCount, shape.layers, precision);
        const TextureChunk chunk(image, {.shape = shape.shape});
        activate(chunk);
        const GLuint texture = bound(shape.binding);
        ASSERT_NE(texture, 0u);
        EXPECT_EQ(levelParameter(texture, GL_TEXTURE_INTERNAL_FORMAT),
                  (precision == Precision::Half ? kHalf : kSingle)[channelCount - 1]);
        const auto texels = readBack<float>(texture, channelCount, GL_FLOAT, image->values().size());
        EXPECT_TRUE(std::equal(texels.begin(), texels.end(), image->values().begin()));
        chunk.deactivate(context(), textureSlot(kUnit));
      }
}

TEST_F(TextureChunkTest, ByteFormatsAreSizedAndComeBackExactly) {
  constexpr GLint kLinear[] = {GL_R8, GL_RG8, GL_RGB8, GL_RGBA8};
  constexpr GLint kSrgb[] = {GL_SRGB8, GL_SRGB8_ALPHA8, GL_SRGB8, GL_SRGB8_ALPHA8};
  for (const bool srgb : {false, true})
    for (int channelCount = 1; channelCount <= 4; ++channelCount) {
      SCOPED_TRACE(testing::Message() << "srgb " << srgb << ", channels " << channelCount);
      const auto image = std::make_shared<Image>(17, 17, channelCount);
      std::iota(image->bytes.begin(), image->bytes.end(), std::uint8_t{0});
      const TextureChunk chunk(image, {.srgb = srgb});
      activate(chunk);
      const GLuint texture = bound(GL_TEXTURE_BINDING_2D);
      EXPECT_EQ(levelParameter(texture, GL_TEXTURE_INTERNAL_FORMAT),
                (srgb ? kSrgb : kLinear)[channelCount - 1]);
      const bool grey = srgb && channelCount <= 2;
      const int stored = grey ? channelCount + 2 : channelCount;
      const auto texels = readBack<std::uint8_t>(texture, stored, GL_UNSIGNED_BYTE,
                                                 std::size_t{17} * 17 * std::size_t(stored));
      for (int i = 0; i < 17 * 17; ++i)
        for (int c = 0; c < stored; ++c) {
          const int source = !grey ? c : c == 3 ? 1 : 0;
          ASSERT_EQ(texels[std::size_t(i * stored + c)],
                    image->bytes[std::size_t(i * channelCount + source)]);
        }
    }
}

TEST_F(TextureChunkTest, WordFormatsAreSizedAndComeBackExactly) {
  constexpr GLint kFormats[] = {GL_R16, GL_RG16, GL_RGB16, GL_RGBA16};
  for (int channelCount = 1; channelCount <= 4; ++channelCount) {
    auto image = std::make_shared<WideImage>(WideImage{7, 5, channelCount, {}});
    for (int i = 0; i < 35 * channelCount; ++i) image->words.push_back(static_cast<std::uint16_t>(467 * i));
    const TextureChunk chunk(std::shared_ptr<const WideImage>(image), {.filter = TextureFilter::Mipmapped});
    activate(chunk);
    const GLuint texture = bound(GL_TEXTURE_BINDING_2D);
    EXPECT_EQ(levelParameter(texture, GL_TEXTURE_INTERNAL_FORMAT), kFormats[channelCount - 1]);
    EXPECT_EQ(readBack<std::uint16_t>(texture, channelCount, GL_UNSIGNED_SHORT, image->words.size()),
              image->words);
  }
}

TEST_F(TextureChunkTest, SamplingOptionsReachTheTexture) {
  const auto image = values(8, 4, 1, 1, Precision::Float);
  const TextureChunk chunk(image, {.filter = TextureFilter::Mipmapped, .wrap = TextureWrap::Repeat});
  activate(chunk);
  const GLuint texture = bound(GL_TEXTURE_BINDING_2D);
  GLint value = 0;
  glGetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_LEVELS, &value);
  EXPECT_EQ(value, 4);
  glGetTextureParameteriv(texture, GL_TEXTURE_MIN_FILTER, &value);
  EXPECT_EQ(value, GL_LINEAR_MIPMAP_LINEAR);
  glGetTextureParameteriv(texture, GL_TEXTURE_WRAP_T, &value);
  EXPECT_EQ(value, GL_REPEAT);

  // The coarsest level is the mean, so it was made from the image.
  float coarsest = 0.0f;
  glGetTextureImage(texture, 3, GL_RED, GL_FLOAT, sizeof coarsest, &coarsest);
  const float sum = std::accumulate(image->values().begin(), image->values().end(), 0.0f);
  EXPECT_NEAR(coarsest, sum / 32.0f, 1e-3f * std::abs(sum / 32.0f));
}

TEST_F(TextureChunkTest, SameLayoutRefreshesAndAnotherRemakes) {
  TextureChunk chunk(values(4, 4, 2, 1, Precision::Float));
  activate(chunk);
  const GLuint first = bound(GL_TEXTURE_BINDING_2D);

  auto changed = values(4, 4, 2, 1, Precision::Float);
  changed->at(3, 2, 1) = 42.0f;
  chunk.setImage(changed);
  activate(chunk);
  EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D), first);
  EXPECT_EQ(readBack<float>(first, 2, GL_FLOAT, 32)[(2 * 4 + 3) * 2 + 1], 42.0f);

  // Only the format differs: sizes and target do not make textures equal.
  chunk.setImage(values(4, 4, 2, 1, Precision::Half));
  activate(chunk);
  EXPECT_EQ(levelParameter(bound(GL_TEXTURE_BINDING_2D), GL_TEXTURE_INTERNAL_FORMAT), GL_RG16F);
  chunk.setImage(std::make_shared<const Image>(4, 4, 2));
  activate(chunk);
  EXPECT_EQ(levelParameter(bound(GL_TEXTURE_BINDING_2D), GL_TEXTURE_INTERNAL_FORMAT), GL_RG8);
}

TEST_F(TextureChunkTest, ChangingTheTargetLeavesNothingOnTheOldOne) {
  const TextureChunk flat(values(4, 4, 1, 1, Precision::Half));
  const TextureChunk array(values(4, 4, 1, 2, Precision::Half), {.shape = TextureShape::Array});
  activate(flat);
  array.changeFrom(context(), flat, textureSlot(kUnit));
  EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D), 0u);
  EXPECT_NE(bound(GL_TEXTURE_BINDING_2D_ARRAY), 0u);
}

TEST_F(TextureChunkTest, EmptyImageUnbindsThePreviousTexture) {
  const TextureChunk full(values(4, 4, 1, 1, Precision::Half));
  TextureChunk changing(values(4, 4, 1, 1, Precision::Half));
  activate(full);
  changing.changeFrom(context(), full, textureSlot(kUnit));
  EXPECT_NE(bound(GL_TEXTURE_BINDING_2D), 0u);
  changing.setImage(std::make_shared<const FloatImage>());
  changing.changeFrom(context(), full, textureSlot(kUnit));
  EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D), 0u);
}

TEST_F(TextureChunkTest, ImageLargerThanTheGLAllowsIsReported) {
  const int width = context().limits().textureSize + 1;
  activate(TextureChunk(values(width, 1, 1, 1, Precision::Half)));
  EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D), 0u);
  const auto error = context().takeErrors();
  ASSERT_FALSE(error);
  EXPECT_THAT(error.error().what, testing::HasSubstr(std::to_string(width) + " x 1 x 1 is larger"));
}

TEST(TextureChunkDeathTest, ShapesAskForImagesThatFitThem) {
  const auto image = [](int width, int layers) { return values(width, 4, 1, layers, Precision::Half); };
  EXPECT_DEATH(TextureChunk(image(4, 2)), "one layer");
  EXPECT_DEATH(CubeTextureChunk(image(4, 5)), "six square layers");
  EXPECT_DEATH(CubeTextureChunk(image(3, 6)), "six square layers");
  EXPECT_DEATH(TextureChunk(image(4, 1), {.shape = TextureShape::Rectangle, .wrap = TextureWrap::Repeat}),
               "no repeat");
  EXPECT_DEATH(
      TextureChunk(image(4, 1), {.shape = TextureShape::Rectangle, .filter = TextureFilter::Mipmapped}),
      "no mipmaps");
}

// Numbers that tell level, layer and texel.
std::shared_ptr<TextureImage> levels(TexelType type, int count) {
  const int channels = type == TexelType::SharedExponent ? 3 : 4;
  auto image = std::make_shared<TextureImage>(5, 4, 3, channels, type, count);
  float number = 0.0f;
  for (int level = 0; level < count; ++level)
    for (int layer = 0; layer < 3; ++layer)
      for (int y = 0; y < image->height(level); ++y)
        for (int x = 0; x < image->width(level); ++x, number += 0.25f) {
          const std::array values{number, 0.5f, 2.0f * number, -number};
          image->set(x, y, layer, 0, std::span(values).first(static_cast<std::size_t>(channels)), level);
        }
  return image;
}

TEST_F(TextureChunkTest, ATextureImageBringsItsLevels) {
  const std::pair<TexelType, GLint> types[] = {{TexelType::Half, GL_RGBA16F},
                                               {TexelType::Float, GL_RGBA32F},
                                               {TexelType::SignedByte, GL_RGBA8_SNORM},
                                               {TexelType::SharedExponent, GL_RGB9_E5}};
  for (const auto& [type, format] : types) {
    const auto image = levels(type, 3);
    const TextureChunk chunk(image, {.shape = TextureShape::Array, .filter = TextureFilter::Mipmapped});
    chunk.activate(context(), textureSlot(kUnit));
    const GLuint texture = bound(GL_TEXTURE_BINDING_2D_ARRAY);
    EXPECT_EQ(levelParameter(texture, GL_TEXTURE_INTERNAL_FORMAT), format);
    for (int level = 0; level < 3; ++level) {
      std::vector<float> texels(static_cast<std::size_t>(image->width(level) * image->height(level) * 3 * 4));
      glGetTextureImage(texture, level, GL_RGBA, GL_FLOAT,
                        static_cast<GLsizei>(texels.size() * sizeof(float)), texels.data());
      std::size_t i = 0;
      for (int layer = 0; layer < 3; ++layer)
        for (int y = 0; y < image->height(level); ++y)
          for (int x = 0; x < image->width(level); ++x)
            for (int c = 0; c < 4; ++c, ++i) {
              if (c == image->channels()) continue;
              ASSERT_FLOAT_EQ(texels[i], image->at(x, y, layer, c, level));
            }
    }
    chunk.deactivate(context(), textureSlot(kUnit));
  }
}

TEST_F(TextureChunkTest, ASourceIsAskedOnceAContext) {
  int asked = 0;
  const auto source =
      std::make_shared<const TextureSource>([&]() -> Result<std::shared_ptr<const TextureImage>> {
        ++asked;
        return levels(TexelType::Half, 1);
      });
  const TextureChunk chunk(source, {.shape = TextureShape::Array});
  for (int i = 0; i < 3; ++i) {
    chunk.activate(context(), textureSlot(kUnit));
    EXPECT_NE(bound(GL_TEXTURE_BINDING_2D_ARRAY), 0u);
    chunk.deactivate(context(), textureSlot(kUnit));
  }
  EXPECT_EQ(asked, 1);
  const auto other = test::valueOf(HeadlessWindow::create());
  chunk.activate(other->context(), textureSlot(kUnit));
  EXPECT_EQ(asked, 2);
  chunk.deactivate(other->context(), textureSlot(kUnit));
  window->makeCurrent();
}

TEST_F(TextureChunkTest, WhatASourceFailsWithIsReported) {
  const auto source = std::make_shared<const TextureSource>(
      []() -> Result<std::shared_ptr<const TextureImage>> { return fail("it is gone", "wool.rf.exr"); });
  const TextureChunk chunk(source, {.shape = TextureShape::Array});
  chunk.activate(context(), textureSlot(kUnit));
  EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D_ARRAY), 0u);
  EXPECT_EQ(context().takeErrors().error().message(), "wool.rf.exr: it is gone");
}

}  // namespace
}  // namespace weft
