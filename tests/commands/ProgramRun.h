#pragma once

#include <string>
#include <vector>

namespace weft::test {

/// How a program ended and what it printed.
struct ProgramRun {
  int exitCode = -1;  ///< 128 + the signal where one ended it
  std::string out;
  std::string err;
};

/// Runs a program built here ("weft-info"), or any other by its absolute path, and waits for its
/// end.
ProgramRun runProgram(const std::string& name, const std::vector<std::string>& arguments);

}  // namespace weft::test
