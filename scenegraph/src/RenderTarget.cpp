#include "weft/scenegraph/RenderTarget.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "weft/chunks/GLName.h"

namespace weft {

namespace {

struct TargetObjects {
  GLTexture color;
  GLTexture depth;
  GLFramebuffer framebuffer;
};

GLenum colorFormat(Precision precision) {
  return precision == Precision::Half ? GL_RGBA16F : GL_RGBA32F;
}

/// Asks without an error; a driver may still run out of memory later.
bool allows(GLenum format, int width, int height) {
  GLint granted = 0;
  glTexImage2D(GL_PROXY_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA, GL_FLOAT,
               nullptr);
  glGetTexLevelParameteriv(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &granted);
  return granted == width;
}

GLTexture makeImage(GLenum format, int width, int height) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  glTextureStorage2D(name, 1, format, width, height);
  return GLTexture(name);
}

/// False where the driver has no memory for it.
bool make(TargetObjects& objects, Precision precision, int width, int height) {
  TargetObjects made;
  made.color = makeImage(colorFormat(precision), width, height);
  made.depth = makeImage(GL_DEPTH_COMPONENT32F, width, height);
  made.framebuffer = createGL<GLFramebuffer>(glCreateFramebuffers);
  glNamedFramebufferTexture(made.framebuffer, GL_COLOR_ATTACHMENT0, made.color, 0);
  glNamedFramebufferTexture(made.framebuffer, GL_DEPTH_ATTACHMENT, made.depth, 0);
  // Every OpenGL 4.5 can render to these formats, so that only storage can be missing.
  if (glCheckNamedFramebufferStatus(made.framebuffer, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return false;
  objects = std::move(made);
  return true;
}

}  // namespace

RenderTarget::RenderTarget(int width, int height, Precision precision)
    : width_(width), height_(height), precision_(precision) {
  WEFT_EXPECT(width > 0 && height > 0, "a render target has a positive size");
}

Result<void> RenderTarget::prepare(GLContext& context) const {
  auto& objects = context.objectsOf<TargetObjects>(owner_);
  if (objects.framebuffer) return {};
  const int limit = context.limits().textureSize;
  if (width_ > limit || height_ > limit)
    return fail(fmt::format("a picture of {} x {} is larger than the {} x {} that this OpenGL allows", width_,
                            height_, limit, limit),
                {}, "make the picture smaller");
  const bool wasWell = !context.failed();
  if (allows(colorFormat(precision_), width_, height_) && make(objects, precision_, width_, height_))
    return {};
  if (wasWell) (void)context.takeErrors();  // GL's own words for it
  const double pixelBytes = precision_ == Precision::Half ? 8.0 : 16.0;
  return fail(fmt::format("OpenGL has no memory for a picture of {} x {}, {:.1f} GiB", width_, height_,
                          pixelBytes * width_ * height_ / (1 << 30)),
              {}, "make the picture smaller");
}

void RenderTarget::bindAndClear(GLContext& context, const glm::vec4& background) const {
  if (auto made = prepare(context); !made) return context.report(std::move(made.error()));
  const auto& objects = context.objectsOf<TargetObjects>(owner_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, objects.framebuffer);
  glViewport(0, 0, width_, height_);
  const float farthest = 1.0f;
  glClearNamedFramebufferfv(objects.framebuffer, GL_COLOR, 0, &background.x);
  glClearNamedFramebufferfv(objects.framebuffer, GL_DEPTH, 0, &farthest);
}

void RenderTarget::unbind() {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
}

FloatImage RenderTarget::read(GLContext& context, int downsample) const {
  WEFT_EXPECT(downsample > 0 && width_ % downsample == 0 && height_ % downsample == 0,
              "the size is a multiple of downsample");
  FloatImage image(width_ / downsample, height_ / downsample, {"R", "G", "B", "A"});
  const auto& objects = context.objectsOf<TargetObjects>(owner_);
  if (!objects.framebuffer) return image;

  // Row by row of the result: GL counts bytes in 31 bits, and a whole picture can be gigabytes.
  std::vector<float> pixels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(downsample) * 4);
  const float weight = 1.0f / static_cast<float>(downsample * downsample);
  for (int row = 0; row < image.height(); ++row) {
    const int lowest = height_ - (row + 1) * downsample;  // GL's first row is the bottom one
    glGetTextureSubImage(objects.color, 0, 0, lowest, 0, width_, downsample, 1, GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
    const float* pixel = pixels.data();
    for (int y = 0; y < downsample; ++y)
      for (int x = 0; x < width_; ++x)
        for (float& value : image.texel(x / downsample, row)) value += weight * *pixel++;
  }
  if (downsample == 1) image.setPrecision(precision_);
  return image;
}

}  // namespace weft
