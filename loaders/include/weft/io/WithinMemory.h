#pragma once

#include <new>
#include <string>

#include "weft/core/Result.h"

namespace weft {

/// What `read` returns, a Result; a failure that says so where memory runs out in it. `where` names
/// the source.
template <class Read>
auto withinMemory(const std::string& where, const Read& read) -> decltype(read()) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory to read it", where);
  }
}

}  // namespace weft
