#pragma once

#include "weft/chunks/BlockChunk.h"

namespace weft {

/// The bytes of a `layout(std430, binding = N) readonly buffer`; every GL allows 128 MiB.
class StorageBlockChunk : public BlockChunk {
 public:
  explicit StorageBlockChunk(std::span<const std::byte> bytes) : BlockChunk(StorageSlot, bytes) {}
};

}  // namespace weft
