#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "weft/io/EnvironmentFile.h"

namespace weft {

/// The built-in environment of a name, or else the file.
inline Result<Environment> environmentNamed(const std::string& name) {
  const auto names = Environment::builtinNames();
  if (std::ranges::find(names, name) != names.end()) return Environment::builtin(name);
  std::vector<std::string> warnings;
  return readEnvironment(name, warnings);
}

}  // namespace weft
