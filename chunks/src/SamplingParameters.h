#pragma once

#include <epoxy/gl.h>

#include "weft/chunks/Sampling.h"

namespace weft {

/// Hands every parameter of sampling to glTextureParameteri() or glSamplerParameteri().
void setSampling(const Sampling& sampling, GLuint name,
                 void (*set)(GLuint name, GLenum parameter, GLint value));

}  // namespace weft
