#pragma once

#include <cstdint>

namespace weft {

/// The most pixels a side of an image that is read.
constexpr int kLargestSide = 16384;
/// An image of so many bytes is taken on its file's word, however well the file is packed.
constexpr std::uint64_t kFreeBytes = std::uint64_t{64} << 20;
/// Images of one colour may be packed by more than this to 1, but few others.
constexpr std::uint64_t kUsualExpansion = 64;

}  // namespace weft
