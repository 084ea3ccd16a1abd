#include "SamplingParameters.h"

namespace weft {

namespace {

GLint wrapMode(TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) return GL_CLAMP_TO_EDGE;
  return wrap == TextureWrap::Repeat ? GL_REPEAT : GL_MIRRORED_REPEAT;
}

}  // namespace

void setSampling(const Sampling& sampling, GLuint name, void (*set)(GLuint, GLenum, GLint)) {
  const bool nearest = sampling.filter == TextureFilter::Nearest;
  const bool nearestAbove = sampling.magnification.value_or(sampling.filter) == TextureFilter::Nearest;
  set(name, GL_TEXTURE_MAG_FILTER, nearestAbove ? GL_NEAREST : GL_LINEAR);
  set(name, GL_TEXTURE_MIN_FILTER,
      sampling.filter == TextureFilter::Mipmapped ? GL_LINEAR_MIPMAP_LINEAR
      : nearest                                   ? GL_NEAREST
                                                  : GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    set(name, axis, wrapMode(sampling.wrap));
  if (sampling.wrapV) set(name, GL_TEXTURE_WRAP_T, wrapMode(*sampling.wrapV));
}

}  // namespace weft
