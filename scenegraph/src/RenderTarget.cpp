#include "weft/scenegraph/RenderTarget.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>
#include <utility>
#include <vector>

#include "weft/chunks/GLName.h"

namespace weft {

namespace {

constexpr GLenum kDepthFormat = GL_DEPTH_COMPONENT32F;

struct TargetObjects {
  GLTexture color;
  GLTexture depth;
  GLFramebuffer framebuffer;
};

GLTexture makeImage(GLenum format, int width, int height) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  glTextureStorage2D(name, 1, format, width, height);
  return GLTexture(name);
}

GLenum colorFormat(Precision precision) {
  return precision == Precision::Half ? GL_RGBA16F : GL_RGBA32F;
}

/// Whether GL says that it can hold an image.
bool fits(GLenum format, glm::ivec2 size) {
  const GLenum channels = format == kDepthFormat ? GL_DEPTH_COMPONENT : GL_RGBA;
  glTexImage2D(GL_PROXY_TEXTURE_2D, 0, static_cast<GLint>(format), size.x, size.y, 0, channels, GL_FLOAT,
               nullptr);
  GLint width = 0;
  glGetTexLevelParameteriv(GL_PROXY_TEXTURE_2D, 0, GL_TEXTURE_WIDTH, &width);
  return width != 0;
}

bool fits(const GLLimits& limits, Precision precision, glm::ivec2 size) {
  return std::max(size.x, size.y) <= limits.targetSize && fits(colorFormat(precision), size) &&
         fits(kDepthFormat, size);
}

/// About the largest picture of the same shape that fits.
glm::ivec2 largestLike(const GLLimits& limits, Precision precision, glm::ivec2 size) {
  const auto scaled = [&](double scale) { return glm::max(glm::ivec2(scale * glm::dvec2(size)), 1); };
  double low = 0.0, high = 1.0;
  for (int step = 0; step < 12; ++step) {
    const double middle = 0.5 * (low + high);
    (fits(limits, precision, scaled(middle)) ? low : high) = middle;
  }
  return scaled(low);
}

/// False where the driver has no memory for it.
bool make(TargetObjects& objects, Precision precision, glm::ivec2 size) {
  // What GL says of missing memory would be told instead of what we do.
  const GLboolean tells = glIsEnabled(GL_DEBUG_OUTPUT);
  glDisable(GL_DEBUG_OUTPUT);
  TargetObjects made;
  made.color = makeImage(colorFormat(precision), size.x, size.y);
  made.depth = makeImage(kDepthFormat, size.x, size.y);
  made.framebuffer = createGL<GLFramebuffer>(glCreateFramebuffers);
  glNamedFramebufferTexture(made.framebuffer, GL_COLOR_ATTACHMENT0, made.color, 0);
  glNamedFramebufferTexture(made.framebuffer, GL_DEPTH_ATTACHMENT, made.depth, 0);
  // Every OpenGL 4.5 can render to these formats, so that only storage can be missing.
  const bool complete =
      glCheckNamedFramebufferStatus(made.framebuffer, GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  if (complete)
    objects = std::move(made);
  else
    while (glGetError() != GL_NO_ERROR) continue;
  if (tells) glEnable(GL_DEBUG_OUTPUT);
  return complete;
}

}  // namespace

RenderTarget::RenderTarget(int width, int height, Precision precision)
    : width_(width), height_(height), precision_(precision) {
  WEFT_EXPECT(width > 0 && height > 0, "a render target has a positive size");
}

Result<void> RenderTarget::prepare(GLContext& context) const {
  auto& objects = context.objectsOf<TargetObjects>(owner_);
  if (objects.framebuffer) return {};
  const glm::ivec2 size(width_, height_);
  const char* kind = precision_ == Precision::Half ? "half floats" : "floats";
  if (!fits(context.limits(), precision_, size)) {
    const glm::ivec2 largest = largestLike(context.limits(), precision_, size);
    return fail(
        fmt::format("a picture of {} x {} pixels of {} is larger than the {} x {} that this OpenGL allows",
                    width_, height_, kind, largest.x, largest.y));
  }
  if (make(objects, precision_, size)) return {};
  return fail(
      fmt::format("OpenGL has no memory for a picture of {} x {} pixels of {}", width_, height_, kind), {},
      "make the picture smaller");
}

void RenderTarget::bindAndClear(GLContext& context, const glm::vec4& background) const {
  if (auto prepared = prepare(context); !prepared) return context.report(std::move(prepared.error()));
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
