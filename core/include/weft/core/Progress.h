#pragma once

#include <functional>

namespace weft {

/// Called by long work with the share done, 0..1, from one thread at a time. An empty function is
/// allowed.
using Progress = std::function<void(double fraction)>;

}  // namespace weft
