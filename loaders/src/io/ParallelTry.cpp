#include "weft/io/ParallelTry.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <mutex>

namespace weft {

Result<void> parallelTry(int count, const std::function<Result<void>(int index)>& work) {
  std::atomic<int> lowestFailed = count;
  std::mutex mutex;
  Error error;
  tbb::parallel_for(0, count, [&](int index) {
    if (index > lowestFailed) return;
    Result<void> result = work(index);
    if (result) return;
    const std::scoped_lock lock(mutex);
    if (index > lowestFailed) return;
    lowestFailed = index;
    error = std::move(result).error();
  });
  if (lowestFailed < count) return tl::unexpected<Error>(std::move(error));
  return {};
}

}  // namespace weft
