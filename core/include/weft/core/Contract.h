#pragma once

#include <string_view>

namespace weft {

/// Ends the program with a message: a caller broke a documented contract. Never for bad input,
/// which is a Result.
[[noreturn]] void contractBroken(const char* file, int line, std::string_view message);

}  // namespace weft

/// A precondition that is checked in every build, because a picture computed from a broken one is
/// worse than none.
#define WEFT_EXPECT(condition, message)                                      \
  do {                                                                       \
    if (!(condition)) ::weft::contractBroken(__FILE__, __LINE__, (message)); \
  } while (false)
