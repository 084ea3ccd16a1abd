#include <array>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/CubeTextureChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/SamplerChunk.h"
#include "weft/chunks/StorageBlockChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/materials/ChunkMaterial.h"

namespace weft {
namespace {

/// What shaders see of textures and blocks: a material whose pixel x computes the expression for
/// index x.
class TextureLookupTest : public test::GlTest {
 protected:
  std::vector<float> evaluate(const std::string& declarations, const std::string& expression, int count) {
    test::writeText(folder / "lookup.frag", "#version 450 core\n" + declarations +
                                                "\nout vec4 color;\nvoid main() {\n"
                                                "  int i = int(gl_FragCoord.x);\n  color = vec4(" +
                                                expression + ");\n}\n");
    material.setChunk(ProgramSlot, std::make_shared<ProgramChunk>(
                                       ShaderSource{"mesh.vert", "lookup.frag", {}, {}, folder}));
    const auto root = test::dressed(std::make_shared<ChunkMaterial>(material));
    RenderTarget target(count, count, Precision::Float);
    const auto rendered = renderer.render(context(), *root, test::squareCamera(), target);
    EXPECT_TRUE(rendered) << (rendered ? "" : rendered.error().message());
    const FloatImage image = target.read(context());
    std::vector<float> values;
    for (int x = 0; x < count; ++x) values.push_back(image.at(x, 0, 0));
    return values;
  }

  std::filesystem::path folder = test::testFolder();
  ChunkMaterial material;
};

TEST_F(TextureLookupTest, CubeFacesLieInGLsOrderAndHoldIntegersExactly) {
  auto cube = std::make_shared<FloatImage>(2, 2, std::vector<std::string>{"triangle"}, 6);
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < 4; ++i) cube->at(i % 2, i / 2, 0, face) = static_cast<float>(4001 + 10 * face + i);
  const std::array<glm::vec4, 6> directions{glm::vec4(1, 0.5f, -0.5f, 0), glm::vec4(-1, 0.5f, 0.5f, 0),
                                            glm::vec4(0.5f, 1, 0.5f, 0),  glm::vec4(0.5f, -1, -0.5f, 0),
                                            glm::vec4(0.5f, 0.5f, 1, 0),  glm::vec4(-0.5f, 0.5f, -1, 0)};
  material.setChunk(textureSlot(31), std::make_shared<CubeTextureChunk>(cube));
  material.setChunk(uniformSlot(7), std::make_shared<UniformBlockChunk>(blockBytes(directions)));
  const auto values = evaluate(
      "layout(binding = 31) uniform samplerCube cube;\n"
      "layout(std140, binding = 7) uniform Directions { vec4 directions[6]; };",
      "texture(cube, directions[i].xyz).r", 6);
  // Every direction lies in the face's right half and upper one but for the Y faces', which GL
  // turns: on +Y rows grow with z, on -Y against it.
  EXPECT_EQ(values, (std::vector<float>{4002, 4012, 4024, 4034, 4042, 4052}));
}

TEST_F(TextureLookupTest, ArraySlicesAreTheLayers) {
  auto image = std::make_shared<FloatImage>(3, 1, std::vector<std::string>{"R", "G", "B", "A"}, 4);
  for (int layer = 0; layer < 4; ++layer)
    for (int x = 0; x < 3; ++x) image->at(x, 0, 2, layer) = static_cast<float>(10 * layer + x);
  image->roundToHalf();
  material.setChunk(textureSlot(0),
                    std::make_shared<TextureChunk>(image, TextureOptions{.shape = TextureShape::Array}));
  EXPECT_EQ(evaluate("layout(binding = 0) uniform sampler2DArray parameters;",
                     "texelFetch(parameters, ivec3(i % 3, 0, i / 3), 0).b", 12),
            (std::vector<float>{0, 1, 2, 10, 11, 12, 20, 21, 22, 30, 31, 32}));
}

TEST_F(TextureLookupTest, RectanglesAreAddressedInTexels) {
  auto image = std::make_shared<FloatImage>(4, 3, std::vector<std::string>{"Y"});
  for (int i = 0; i < 12; ++i) image->at(i % 4, i / 4, 0) = static_cast<float>(i);
  material.setChunk(textureSlot(1),
                    std::make_shared<TextureChunk>(image, TextureOptions{.shape = TextureShape::Rectangle}));
  EXPECT_EQ(evaluate("layout(binding = 1) uniform sampler2DRect image;",
                     "texture(image, vec2(i % 4, i / 4) + 0.5).r", 12),
            (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
}

TEST_F(TextureLookupTest, SamplersOverruleTheTextureOfTheirUnit) {
  const auto image = std::make_shared<FloatImage>(2, 1, std::vector<std::string>{"R"});
  image->at(1, 0, 0) = 1.0f;
  const auto texture = std::make_shared<TextureChunk>(image, TextureOptions{.wrap = TextureWrap::Repeat});
  material.setChunk(textureSlot(3), texture);
  material.setChunk(textureSlot(4), texture);
  material.setChunk(samplerSlot(4),
                    std::make_shared<SamplerChunk>(Sampling{.filter = TextureFilter::Linear}));
  const std::string declarations =
      "layout(binding = 3) uniform sampler2D repeated;\nlayout(binding = 4) uniform sampler2D clamped;";
  EXPECT_EQ(evaluate(declarations, "texture(repeated, vec2(0.2 + 0.5 * i, 0.5)).r", 4),
            (std::vector<float>{0, 1, 0, 1}));
  const auto clamped = evaluate(declarations, "texture(clamped, vec2(0.5 + 0.5 * i, 0.5)).r", 4);
  EXPECT_NEAR(clamped[0], 0.5f, 0.01f);
  for (int i = 1; i < 4; ++i) EXPECT_EQ(clamped[static_cast<std::size_t>(i)], 1.0f);
}

TEST_F(TextureLookupTest, EmptyImageSamplesAsBlack) {
  material.setChunk(textureSlot(0), std::make_shared<TextureChunk>(std::make_shared<const FloatImage>()));
  EXPECT_EQ(evaluate("layout(binding = 0) uniform sampler2D image;", "texture(image, vec2(0.5)).r", 1),
            std::vector<float>{0});
}

TEST_F(TextureLookupTest, StorageBlocksHoldMoreThanUniformOnesMust) {
  std::vector<float> numbers(100000);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<float>(i);
  material.setChunk(storageSlot(3), std::make_shared<StorageBlockChunk>(blockBytes(numbers)));
  EXPECT_EQ(evaluate("layout(std430, binding = 3) readonly buffer Numbers { float numbers[]; };",
                     "numbers[i * 33333]", 4),
            (std::vector<float>{0, 33333, 66666, 99999}));
}

}  // namespace
}  // namespace weft
