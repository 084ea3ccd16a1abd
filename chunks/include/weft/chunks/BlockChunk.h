#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "weft/chunks/Chunk.h"

namespace weft {

/// Bytes that a program reads as a block: what UniformBlockChunk and StorageBlockChunk have in
/// common. Default: no buffer.
class BlockChunk : public Chunk {
 public:
  Slot kind() const override { return kind_; }
  void activate(GLContext& context, unsigned slot) const override;
  void changeFrom(GLContext& context, const Chunk& old, unsigned slot) const override;
  void deactivate(GLContext& context, unsigned slot) const override;

  /// Replaces the bytes; empty ones leave the slot without a buffer.
  void set(std::span<const std::byte> bytes);

 protected:
  BlockChunk(Slot kind, std::span<const std::byte> bytes) : kind_(kind), bytes_(bytes.begin(), bytes.end()) {}

 private:
  bool isEqual(const Chunk& other) const override;

  Slot kind_;
  std::vector<std::byte> bytes_;
  std::uint64_t version_ = 1;
  std::shared_ptr<const void> owner_ = std::make_shared<char>();
};

/// The bytes of a C++ struct, or of an array of them, that repeats the layout of a GLSL block.
template <class T>
std::span<const std::byte> blockBytes(const T& block) {
  if constexpr (requires { std::span(block); }) {
    return std::as_bytes(std::span(block));
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span(&block, 1));
  }
}

}  // namespace weft
