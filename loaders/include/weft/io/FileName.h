#pragma once

#include <string>
#include <string_view>

namespace weft {

/// A file's name in Unicode's normal form C: macOS writes "Münze" with a dot or accent of its own
/// (form D), other systems with one character, so that equal names differ in bytes. What is not
/// UTF-8 stays as it is.
std::string composedName(std::string_view name);

/// composedName() without the difference of upper and lower case: equal for names that Windows and
/// macOS take for the same file.
std::string foldedName(std::string_view name);

}  // namespace weft
