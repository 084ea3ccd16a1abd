#include "weft/scenegraph/PassiveWindow.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <numbers>

#include "GlSnapshot.h"
#include "GlTest.h"
#include "TestSupport.h"
#include "weft/chunks/GLName.h"
#include "weft/chunks/GLStateGuard.h"
#include "weft/core/Color.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scenegraph/Light.h"

namespace weft {
namespace {

using test::squareCamera;
using test::valueOf;
using testing::HasSubstr;

constexpr int kSide = 8;

/// What a host draws into.
struct HostFramebuffer {
  GLTexture color, depth;
  GLFramebuffer name;

  explicit HostFramebuffer(GLenum format = GL_RGBA32F) {
    color = image(format);
    depth = image(GL_DEPTH_COMPONENT24);
    name = createGL<GLFramebuffer>(glCreateFramebuffers);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color, 0);
    glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, name);
    glViewport(0, 0, kSide, kSide);
    clear();
  }

  static GLTexture image(GLenum format) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, format, kSide, kSide);
    return GLTexture(texture);
  }

  void clear() const {
    const GLfloat black[] = {0, 0, 0, 1}, farthest = 1;
    glClearNamedFramebufferfv(name, GL_COLOR, 0, black);
    glClearNamedFramebufferfv(name, GL_DEPTH, 0, &farthest);
  }

  /// Stored values, row 0 at the bottom; of 8 bits as 0..1.
  std::vector<glm::vec4> pixels() const {
    std::vector<glm::vec4> values(kSide * kSide);
    glGetTextureImage(color, 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(glm::vec4)),
                      values.data());
    return values;
  }
};

/// Everything that Weft depends on or changes, set as it must not be.
class HostileState {
 public:
  HostileState() {
    for (GLBuffer& buffer : buffers_) {
      buffer = createGL<GLBuffer>(glCreateBuffers);
      glNamedBufferStorage(buffer, 4096, nullptr, 0);
    }
    sampler_ = createGL<GLSampler>(glCreateSamplers);
    array_ = createGL<GLVertexArray>(glCreateVertexArrays);
    glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube_);
    glTextureStorage2D(cube_, 1, GL_R8, 4, 4);
    const GLchar* code = "#version 450\nvoid main() { gl_Position = vec4(0); }";
    program_ = GLProgram(glCreateShaderProgramv(GL_VERTEX_SHADER, 1, &code));
    bind();
    set();
  }
  ~HostileState() { glDeleteTextures(1, &cube_); }

 private:
  void bind() {
    glUseProgram(program_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffers_[0]);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, buffers_[1]);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, buffers_[0]);
    for (GLuint i = 0; i < 8; ++i) {
      glBindBufferRange(GL_UNIFORM_BUFFER, i, buffers_[i % 2], 256 * i, 256);
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers_[i % 2]);
    }
    glBindBuffer(GL_UNIFORM_BUFFER, buffers_[1]);
    for (GLuint unit = 0; unit < 32; ++unit) {
      glBindTextureUnit(unit, own_.color);
      glBindTextureUnit(unit, cube_);
      glBindSampler(unit, sampler_);
    }
    glActiveTexture(GL_TEXTURE7);
  }

  void set() {
    for (const GLenum name :
         {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_COLOR_LOGIC_OP, GL_SAMPLE_ALPHA_TO_COVERAGE,
          GL_DEPTH_CLAMP, GL_POLYGON_OFFSET_FILL, GL_POLYGON_OFFSET_LINE, GL_PRIMITIVE_RESTART,
          GL_PROGRAM_POINT_SIZE, GL_RASTERIZER_DISCARD, GL_TEXTURE_CUBE_MAP_SEAMLESS, GL_CLIP_DISTANCE0,
          GL_CLIP_DISTANCE7})
      glEnable(name);
    glDisablei(GL_BLEND, 3);
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_DST_ALPHA);
    glBlendFunci(5, GL_ZERO, GL_ZERO);
    glBlendEquationSeparate(GL_FUNC_REVERSE_SUBTRACT, GL_MAX);
    glDepthFunc(GL_NEVER);
    glDepthMask(GL_FALSE);
    glCullFace(GL_FRONT_AND_BACK);
    glFrontFace(GL_CW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glPolygonOffset(3, 1000);
    glPrimitiveRestartIndex(2);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    glPointSize(5);
    for (const GLenum name :
         {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
          GL_UNPACK_SKIP_IMAGES, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS})
      glPixelStorei(name, 3);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    glPixelStorei(GL_UNPACK_SWAP_BYTES, GL_TRUE);
  }

  HostFramebuffer own_;
  GLBuffer buffers_[2];
  GLSampler sampler_;
  GLVertexArray array_;
  GLProgram program_;
  GLuint cube_ = 0;
};

/// A textured square under a light from the viewer, with parts in the background's place, too.
std::shared_ptr<Node> scene() {
  auto image = std::make_shared<Image>(3, 3, 3);
  for (std::size_t i = 0; i < image->bytes.size(); ++i)
    image->bytes[i] = static_cast<std::uint8_t>(9 * i + 10);
  auto root =
      std::make_shared<Node>(std::make_shared<DirectionalLight>(glm::vec3(std::numbers::pi_v<float>)));
  root->addChild(test::dressed(std::make_shared<LambertMaterial>(
      LambertOptions{.baseColor = {1.0f, 0.9f, 0.8f, 1.0f}, .baseColorTexture = image})));
  return root;
}

class PassiveWindowTest : public test::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (window) passive = valueOf(PassiveWindow::adopt());
  }
  void TearDown() override {
    if (window) {
      window->makeCurrent();
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    passive.reset();
    GlTest::TearDown();
  }

  void draw(const Node& root, HostState after = HostState::Restored) {
    test::requireDone(passive->render(root, squareCamera(), after));
  }

  std::unique_ptr<PassiveWindow> passive;
};

TEST_F(PassiveWindowTest, DrawsWhatItDrawsElsewhereWhateverTheHostHasSetAndRestoresIt) {
  const auto root = scene();
  const FloatImage expected = picture(*root, kSide, kSide);
  const HostFramebuffer framebuffer;
  {
    const HostileState hostile;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name);
    const test::GlSnapshot before = test::takeHostSnapshot();
    for (int frame = 0; frame < 2; ++frame) {
      draw(*root);
      EXPECT_EQ(test::difference(test::takeHostSnapshot(), before), "") << "frame " << frame;
    }
    draw(*root, HostState::Defaults);
  }
  resetGLState();
  const std::vector<glm::vec4> actual = framebuffer.pixels();
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      for (int channel = 0; channel < 4; ++channel)
        ASSERT_EQ(actual[static_cast<std::size_t>((kSide - 1 - y) * kSide + x)][channel],
                  expected.at(x, y, channel))
            << x << ' ' << y;
}

TEST_F(PassiveWindowTest, CanLeaveGlAsItStartsUp) {
  const auto root = scene();
  const HostFramebuffer framebuffer;
  const test::GlSnapshot start = test::takeHostSnapshot();
  glEnable(GL_BLEND);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glUseProgram(0);
  draw(*root, HostState::Defaults);
  EXPECT_EQ(test::difference(test::takeHostSnapshot(), start), "");
}

TEST_F(PassiveWindowTest, AGuardAroundAPictureOfItsOwnGivesFramebufferAndViewportBack) {
  const HostFramebuffer framebuffer;
  glViewport(1, 2, 3, 4);
  glViewportIndexedf(5, 0.5f, 0, 7, 7);
  const test::GlSnapshot before = test::takeHostSnapshot();
  {
    const GLStateGuard guard;
    resetGLState();
    picture(*scene());
  }
  EXPECT_EQ(test::difference(test::takeHostSnapshot(), before), "");
  GLfloat viewport[4] = {};
  glGetFloati_v(GL_VIEWPORT, 5, viewport);
  EXPECT_EQ(viewport[0], 0.5f);
}

TEST_F(PassiveWindowTest, EncodesColoursWhereNobodyElseDoes) {
  const auto root = scene();
  const FloatImage linear = picture(*root, kSide, kSide);
  const auto expectEncoded = [&](GLenum format, bool glEncodes) {
    const HostFramebuffer framebuffer(format);
    (glEncodes ? glEnable : glDisable)(GL_FRAMEBUFFER_SRGB);
    draw(*root);
    EXPECT_EQ(glIsEnabled(GL_FRAMEBUFFER_SRGB), glEncodes);
    glDisable(GL_FRAMEBUFFER_SRGB);
    // Bytes as stored, of an sRGB image, too.
    std::vector<std::uint8_t> bytes(4 * kSide * kSide);
    glReadPixels(0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
    for (int y = 0; y < kSide; ++y)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(bytes[static_cast<std::size_t>(4 * ((kSide - 1 - y) * kSide + 3) + channel)],
                    255.0f * encode(Encoding::Srgb, linear.at(3, y, channel)), 1.0f)
            << format << ' ' << glEncodes << ' ' << y;
  };
  expectEncoded(GL_RGBA8, false);
  expectEncoded(GL_RGBA8, true);
  expectEncoded(GL_SRGB8_ALPHA8, false);
  expectEncoded(GL_SRGB8_ALPHA8, true);
}

TEST_F(PassiveWindowTest, StaysInTheViewportAndBehindTheHost) {
  const auto root = scene();
  const HostFramebuffer framebuffer;
  glViewport(4, 0, 4, 8);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 8, 4);
  draw(*root);
  const auto drawn = [&](int x, int y) {
    return framebuffer.pixels()[static_cast<std::size_t>(y * kSide + x)].r > 0.0f;
  };
  EXPECT_TRUE(drawn(5, 3));
  EXPECT_FALSE(drawn(3, 3)) << "beside the viewport";
  EXPECT_FALSE(drawn(5, 4)) << "outside of the scissor";

  glDisable(GL_SCISSOR_TEST);
  framebuffer.clear();
  const GLfloat nearest = 0;
  glClearNamedFramebufferfv(framebuffer.name, GL_DEPTH, 0, &nearest);
  draw(*root);
  EXPECT_FALSE(drawn(5, 3)) << "behind what the host has drawn";
  glViewport(0, 0, 0, 0);
  draw(*root);
}

TEST_F(PassiveWindowTest, TakesTheHostsProjection) {
  const auto root = scene();
  const HostFramebuffer framebuffer;
  draw(*root);
  const auto expected = framebuffer.pixels();
  framebuffer.clear();
  Camera camera = squareCamera();
  camera.ownProjection = camera.projection(1.0f);
  camera.verticalFieldOfView = 0.01f;
  test::requireDone(passive->render(*root, camera));
  EXPECT_EQ(framebuffer.pixels(), expected);
  EXPECT_EQ(camera.eye(), glm::dvec4(0, 0, 2, 1));
  camera.ownProjection = Camera{.orthographicHeight = 3.0f}.projection(1.0f);
  EXPECT_EQ(camera.eye(), glm::dvec4(0, 0, 1, 0)) << "rays are parallel";
}

TEST_F(PassiveWindowTest, OneSceneInTwoContextsThatEndBeforeIt) {
  const auto root = scene();
  for (int i = 0; i < 2; ++i) {
    const auto other = valueOf(HeadlessWindow::create(true));
    {
      const auto host = valueOf(PassiveWindow::adopt());
      const HostFramebuffer framebuffer;
      test::requireDone(host->render(*root, squareCamera()));
      EXPECT_GT(framebuffer.pixels()[9].r, 0.0f);
    }
    test::requireDone(other->context().takeErrors());
  }
}

TEST_F(PassiveWindowTest, MayOutliveItsContext) {
  const HostFramebuffer framebuffer;
  draw(*scene());
  window.reset();
  passive.reset();
}

TEST_F(PassiveWindowTest, NeedsAContextAndAFramebuffer) {
  const auto rendered = passive->render(*scene(), squareCamera());
  ASSERT_FALSE(rendered) << "a headless context has no framebuffer of its own";
  EXPECT_THAT(rendered.error().message(), HasSubstr("framebuffer is not complete"));
  passive.reset();
  window.reset();
  const auto adopted = PassiveWindow::adopt();
  ASSERT_FALSE(adopted);
  EXPECT_THAT(adopted.error().message(), HasSubstr("no OpenGL context is current"));
}

}  // namespace
}  // namespace weft
