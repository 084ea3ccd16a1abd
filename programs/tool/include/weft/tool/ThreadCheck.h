#pragma once

#include "weft/core/Result.h"

namespace weft {

/// Whether so many threads can be started: for programs whose GL driver would start them, because
/// Mesa's waits for ever for one that it does not get.
Result<void> checkThreads(unsigned count);

}  // namespace weft
