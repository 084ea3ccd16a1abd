#include "weft/chunks/GLContext.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace weft {

namespace {

constexpr std::size_t kLeastShare = 1024;  // buckets of objects that one frame looks at

int integer(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

bool isWrong(GLenum source, GLenum type, GLenum severity) {
  // ProgramChunk reports these, with their file
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return false;
  return type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
         severity == GL_DEBUG_SEVERITY_HIGH;
}

void GLAPIENTRY onDebugMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei,
                               const GLchar* message, const void* context) {
  if (!isWrong(source, type, severity)) return;
  // GL takes the pointer as const, but it is the one that reportDebugOutput() gave.
  static_cast<GLContext*>(const_cast<void*>(context))->report({message, "OpenGL", {}});
}

}  // namespace

GLContext::GLContext() {
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  limits_.textureSize = integer(GL_MAX_TEXTURE_SIZE);
  limits_.targetSize = std::min({limits_.textureSize, viewport[0], viewport[1]});
  limits_.textureLayers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS);
  limits_.volumeSize = integer(GL_MAX_3D_TEXTURE_SIZE);
  limits_.cubeSize = integer(GL_MAX_CUBE_MAP_TEXTURE_SIZE);
  limits_.rectangleSize = integer(GL_MAX_RECTANGLE_TEXTURE_SIZE);
  limits_.uniformBlockBytes = integer(GL_MAX_UNIFORM_BLOCK_SIZE);
  limits_.storageBlockBytes = integer(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
}

GLContext::~GLContext() = default;

void GLContext::setProgramVariant(ShaderVariant variant) {
  if (variant == programVariant_) return;
  programVariant_ = std::move(variant);
  ++programVariantRevision_;
}

void GLContext::deleteOrphans() {
  // Looking at every owner would cost a frame of ten thousand meshes more than its drawing.
  const std::size_t buckets = objects_.bucket_count();
  std::vector<const void*> orphans;
  for (std::size_t i = std::min(buckets, std::max(kLeastShare, buckets / 16)); i > 0; --i) {
    nextBucket_ = (nextBucket_ + 1) % buckets;
    for (auto entry = objects_.begin(nextBucket_); entry != objects_.end(nextBucket_); ++entry)
      if (entry->second.owner.expired()) orphans.push_back(entry->first);
  }
  for (const void* orphan : orphans) objects_.erase(orphan);
}

void GLContext::report(Error error) {
  if (!firstError_) firstError_ = std::move(error);
}

Result<void> GLContext::takeErrors() {
  if (!firstError_) return {};
  Error error = std::move(*firstError_);
  firstError_.reset();
  return tl::unexpected(std::move(error));
}

void GLContext::reportDebugOutput() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(&onDebugMessage, this);
}

}  // namespace weft
