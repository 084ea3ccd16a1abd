#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace weft {

/// Whether an OpenGL context of any kind is current on this thread. Never fails, as calls of GL do
/// without one.
bool hasCurrentContext();

/// Owns the name of one GL object, 0 for none. Destroyed where the object's context is current,
/// which GLContext::objectsOf() takes care of, or where none is because the context has ended, and
/// its objects with it.
template <class Deleter>
class GLName {
 public:
  GLName() = default;
  explicit GLName(GLuint name) : name_(name) {}
  GLName(GLName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GLName& operator=(GLName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GLName() {
    if (name_ != 0 && hasCurrentContext()) Deleter()(name_);
  }

  operator GLuint() const { return name_; }

 private:
  GLuint name_ = 0;
};

struct DeleteTexture {
  void operator()(GLuint name) const { glDeleteTextures(1, &name); }
};
struct DeleteSampler {
  void operator()(GLuint name) const { glDeleteSamplers(1, &name); }
};
struct DeleteBuffer {
  void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
};
struct DeleteShader {
  void operator()(GLuint name) const { glDeleteShader(name); }
};
struct DeleteProgram {
  void operator()(GLuint name) const { glDeleteProgram(name); }
};
struct DeleteVertexArray {
  void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
};
struct DeleteFramebuffer {
  void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};

using GLTexture = GLName<DeleteTexture>;
using GLSampler = GLName<DeleteSampler>;
using GLBuffer = GLName<DeleteBuffer>;
using GLShader = GLName<DeleteShader>;
using GLProgram = GLName<DeleteProgram>;
using GLVertexArray = GLName<DeleteVertexArray>;
using GLFramebuffer = GLName<DeleteFramebuffer>;

/// A new GL object of DSA's glCreate...(1, &name).
template <class Name>
Name createGL(void (*create)(GLsizei, GLuint*)) {
  GLuint name = 0;
  create(1, &name);
  return Name(name);
}

}  // namespace weft
