#pragma once

#include "weft/chunks/BlockChunk.h"

namespace weft {

/// The bytes of a `layout(std140, binding = N) uniform` block; every GL allows 16 KiB.
class UniformBlockChunk : public BlockChunk {
 public:
  explicit UniformBlockChunk(std::span<const std::byte> bytes) : BlockChunk(UniformSlot, bytes) {}
};

}  // namespace weft
