#include "weft/core/Contract.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace weft {

void contractBroken(const char* file, int line, std::string_view message) {
  std::fputs(fmt::format("{}:{}: contract broken: {}\n", file, line, message).c_str(), stderr);
  std::abort();
}

}  // namespace weft
