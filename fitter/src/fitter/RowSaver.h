#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "PassRows.h"

namespace weft {

/// Saves finished rows while others are being fitted, in a thread of its own: where fits have one
/// thread, nothing else would come to it before they end.
class RowSaver {
 public:
  /// Saves not sooner than `seconds` after the last time. `warn` hears of the first failure; the
  /// next time tries again.
  RowSaver(PassRows& rows, double seconds, const std::function<void(const std::string&)>& warn);
  ~RowSaver();

  /// There are more finished rows.
  void wake();
  /// Ends the thread. With 0 seconds all finished rows are saved then; fails where they cannot be.
  Result<void> finish();

 private:
  void saveUntilStopped(const std::stop_token& stop);
  void tryToSave();

  using Clock = std::chrono::steady_clock;
  PassRows& rows_;
  Clock::duration pause_;
  const std::function<void(const std::string&)>& warn_;
  bool hasWarned_ = false;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool hasNews_ = false;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace weft
