#include "ScenePicture.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "weft/shaders/ShaderSource.h"

namespace weft {
namespace {

// Linear; 0x28 of 255 in sRGB, as weft-render's pictures.
const glm::vec4 kBackground{0.0212f, 0.0212f, 0.0212f, 1.0f};
const glm::vec4 kEmpty{0.157f, 0.157f, 0.157f, 1.0f};  // the same, encoded

Result<GLProgram> compiled(GLenum stage, const std::string& file) {
  WEFT_TRY(const ShaderText text,
           assembleShader({.vertex = "display.vert", .fragment = "display.frag"}, file));
  const char* code = text.text.c_str();
  GLProgram program(glCreateShaderProgramv(stage, 1, &code));
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) return fail("the shader does not compile", file);
  return program;
}

GLTexture makeImage(GLenum format, glm::ivec2 size) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  glTextureStorage2D(name, 1, format, size.x, size.y);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return GLTexture(name);
}

}  // namespace

Result<std::unique_ptr<ScenePicture>> ScenePicture::create() {
  std::unique_ptr<ScenePicture> picture(new ScenePicture);
  WEFT_TRY(picture->vertex_, compiled(GL_VERTEX_SHADER, "display.vert"));
  WEFT_TRY(picture->fragment_, compiled(GL_FRAGMENT_SHADER, "display.frag"));
  picture->pipeline_ = createGL<GLName<DeletePipeline>>(glCreateProgramPipelines);
  glUseProgramStages(picture->pipeline_, GL_VERTEX_SHADER_BIT, picture->vertex_);
  glUseProgramStages(picture->pipeline_, GL_FRAGMENT_SHADER_BIT, picture->fragment_);
  picture->noVertices_ = createGL<GLVertexArray>(glCreateVertexArrays);
  return picture;
}

glm::vec4 ScenePicture::background() {
  return kBackground;
}

Result<void> ScenePicture::makeTarget(glm::ivec2 size) {
  if (size == size_) return {};
  size_ = drawn_ = {};
  color_ = makeImage(GL_RGBA16F, size);
  depth_ = makeImage(GL_DEPTH_COMPONENT32F, size);
  framebuffer_ = createGL<GLFramebuffer>(glCreateFramebuffers);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, color_, 0);
  glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return fail(fmt::format("OpenGL has no memory for a picture of {} x {} pixels", size.x, size.y), {},
                "make the window smaller");
  size_ = size;
  return {};
}

Result<void> ScenePicture::draw(PassiveWindow& weft, const Node& root, const Camera& camera, glm::ivec2 size,
                                int divisor) {
  WEFT_TRY_VOID(makeTarget(size));
  drawn_ = glm::max(size / divisor, glm::ivec2(1));
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, drawn_.x, drawn_.y);
  glDisable(GL_SCISSOR_TEST);
  const float farthest = 1.0f;
  glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, &kBackground.x);
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &farthest);
  const Result<void> drawn = weft.render(root, camera, HostState::Defaults);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glFinish();
  return drawn;
}

void ScenePicture::show(glm::ivec2 size, float stops, ToneCurve curve) const {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size.x, size.y);
  if (size_.x == 0) {
    glClearBufferfv(GL_COLOR, 0, &kEmpty.x);
    return;
  }
  const glm::vec2 share = glm::vec2(drawn_) / glm::vec2(size_);
  glProgramUniform2f(fragment_, 0, share.x, share.y);
  glProgramUniform1f(fragment_, 1, std::exp2(stops));
  glProgramUniform1i(fragment_, 2, curve == ToneCurve::Soft);
  glUseProgram(0);
  glBindProgramPipeline(pipeline_);
  glBindVertexArray(noVertices_);
  glBindTextureUnit(0, color_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindTextureUnit(0, 0);
  glBindVertexArray(0);
  glBindProgramPipeline(0);
}

}  // namespace weft
