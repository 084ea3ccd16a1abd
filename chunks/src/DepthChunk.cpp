#include "weft/chunks/DepthChunk.h"

#include <epoxy/gl.h>

namespace weft {

namespace {

void set(bool test, bool write) {
  (test ? glEnable : glDisable)(GL_DEPTH_TEST);
  glDepthMask(write ? GL_TRUE : GL_FALSE);
}

}  // namespace

void DepthChunk::activate(GLContext&, unsigned) const {
  set(test_, write_);
}

void DepthChunk::changeFrom(GLContext&, const Chunk& old, unsigned) const {
  const auto& other = static_cast<const DepthChunk&>(old);
  if (test_ != other.test_ || write_ != other.write_) set(test_, write_);
}

void DepthChunk::deactivate(GLContext&, unsigned) const {
  set(false, true);
}

bool DepthChunk::isEqual(const Chunk& other) const {
  const auto& depth = static_cast<const DepthChunk&>(other);
  return test_ == depth.test_ && write_ == depth.write_;
}

}  // namespace weft
