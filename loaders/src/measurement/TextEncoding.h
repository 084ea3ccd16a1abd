#pragma once

#include <string>
#include <string_view>

#include "weft/core/Result.h"

namespace weft {

/// A text file's contents in UTF-8 without a byte order mark: UTF-16 is told by its mark, what is
/// neither that nor UTF-8 is taken as Latin-1, as old Windows programs write it. Fails on UTF-16
/// that is cut off or damaged.
Result<std::string> textInUtf8(std::string_view bytes, const std::string& where);

/// The same for what has no mark: a file's name.
std::string nameInUtf8(std::string_view name);

}  // namespace weft
