#include "weft/chunks/BlockChunk.h"

#include <fmt/format.h>

#include "weft/chunks/GLName.h"

namespace weft {

namespace {

struct BlockObjects {
  GLBuffer buffer;
  std::size_t bytes = 0;
  std::uint64_t version = 0;
};

void bind(Slot kind, unsigned slot, GLuint buffer) {
  glBindBufferBase(kind == UniformSlot ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER, slot - kind, buffer);
  // glBindBufferBase also binds to the target in general, which would outlive a change of slots.
  glBindBuffer(kind == UniformSlot ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER, 0);
}

void upload(BlockObjects& objects, std::span<const std::byte> bytes) {
  const auto size = static_cast<GLsizeiptr>(bytes.size());
  if (objects.bytes == bytes.size()) {
    glNamedBufferSubData(objects.buffer, 0, size, bytes.data());
    return;
  }
  objects.buffer = createGL<GLBuffer>(glCreateBuffers);
  glNamedBufferStorage(objects.buffer, size, bytes.data(), GL_DYNAMIC_STORAGE_BIT);
  objects.bytes = bytes.size();
}

}  // namespace

void BlockChunk::set(std::span<const std::byte> bytes) {
  bytes_.assign(bytes.begin(), bytes.end());
  ++version_;
}

void BlockChunk::activate(GLContext& context, unsigned slot) const {
  const int limit =
      kind_ == UniformSlot ? context.limits().uniformBlockBytes : context.limits().storageBlockBytes;
  if (bytes_.size() > static_cast<std::size_t>(limit)) {
    context.report({fmt::format("a block of {} bytes is larger than the {} that this OpenGL allows",
                                bytes_.size(), limit),
                    {},
                    {}});
  }
  if (bytes_.empty() || bytes_.size() > static_cast<std::size_t>(limit)) return bind(kind_, slot, 0);

  auto& objects = context.objectsOf<BlockObjects>(owner_);
  if (objects.version != version_) {
    upload(objects, bytes_);
    objects.version = version_;
  }
  bind(kind_, slot, objects.buffer);
}

void BlockChunk::changeFrom(GLContext& context, const Chunk&, unsigned slot) const {
  activate(context, slot);  // binds over the old buffer
}

void BlockChunk::deactivate(GLContext&, unsigned slot) const {
  bind(kind_, slot, 0);
}

bool BlockChunk::isEqual(const Chunk& other) const {
  return bytes_ == static_cast<const BlockChunk&>(other).bytes_;
}

}  // namespace weft
