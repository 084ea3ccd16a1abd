#pragma once

#include <atomic>
#include <cstdint>

namespace weft {

/// Stamps changes of trees: every look at a tree moves the clock on, so that later changes have
/// later stamps. One for all trees, since nodes move between them.
inline std::atomic<std::uint64_t> changeClock{1};

}  // namespace weft
