#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace weft {

/// What is wrong with a command line that was not understood: the option, what it takes and what
/// was meant.
std::string explain(CLI::App& app, const CLI::ParseError& error);

/// What is wrong with the numbers of one that was: "nan" passes every check for a range.
std::optional<std::string> findNotANumber(CLI::App& app);

}  // namespace weft
