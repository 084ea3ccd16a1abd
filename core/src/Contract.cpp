#include "weft/core/Contract.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace weft {

void contractBroken(const char* file, int line, std::string_view message) {
  fmt::print(stderr, "{}:{}: contract broken: {}\n", file, line, message);
  std::abort();
}

}  // namespace weft
