#include "weft/core/Checksum.h"

#include <algorithm>
#include <cstring>

namespace weft {

std::uint64_t checksumOf(std::span<const std::byte> bytes, std::uint64_t start) {
  std::uint64_t checksum = start;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min<std::size_t>(8, bytes.size()))) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min<std::size_t>(8, bytes.size()));
    checksum = (checksum ^ word) * 0x100000001b3u;
  }
  return checksum;
}

}  // namespace weft
