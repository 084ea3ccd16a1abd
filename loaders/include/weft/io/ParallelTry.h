#pragma once

#include <functional>

#include "weft/core/Result.h"

namespace weft {

/// Calls `work(0 .. count - 1)` on all threads; the failure of the lowest index is returned,
/// whichever thread meets one first, so that messages do not depend on timing. Work after a failure
/// may be left out.
Result<void> parallelTry(int count, const std::function<Result<void>(int index)>& work);

}  // namespace weft
