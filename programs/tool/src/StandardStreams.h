#pragma once

#include <cstdio>
#include <string_view>

namespace weft {

/// Puts /dev/null in the place of standard streams that are closed, such that using them fails: a
/// file that is opened later must not get what is printed. Call it before anything is opened.
void fillClosedStreams();

/// Prints a text and flushes; false where that fails (a closed pipe, a full disk). Never throws.
bool printText(std::FILE* stream, std::string_view text);

}  // namespace weft
