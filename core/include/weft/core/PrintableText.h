#pragma once

#include <string>
#include <string_view>

namespace weft {

/// A text of unknown origin as one line that a terminal can show: UTF-8 stays, line ends and tabs
/// become blanks, and every other control character or byte that is not UTF-8 becomes "\x1b" with
/// its value.
std::string printable(std::string_view text);

}  // namespace weft
