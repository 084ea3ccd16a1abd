#include "weft/tool/ThreadCheck.h"

#include <fmt/format.h>

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace weft {

Result<void> checkThreads(unsigned count) {
  std::latch seen(1);
  std::vector<std::thread> threads;
  Result<void> result;
  try {
    while (threads.size() < count) threads.emplace_back([&seen] { seen.wait(); });
  } catch (const std::system_error& error) {
    result = fail(
        fmt::format("only {} of {} threads can be had: {}", threads.size(), count, error.code().message()),
        {}, "allow more: ulimit -u");
  }
  seen.count_down();
  for (std::thread& thread : threads) thread.join();
  return result;
}

}  // namespace weft
