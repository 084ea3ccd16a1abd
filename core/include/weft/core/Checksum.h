#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace weft {

/// FNV-1a over words of eight bytes, the last one filled with zeros: against chance, not against
/// malice. Goes on from another checksum.
std::uint64_t checksumOf(std::span<const std::byte> bytes, std::uint64_t start = 0xcbf29ce484222325u);

}  // namespace weft
