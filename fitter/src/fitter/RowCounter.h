#pragma once

#include <cmath>
#include <mutex>

#include "weft/core/Progress.h"

namespace weft {

/// Calls back for each row that is done, one thread at a time, with what is done of all passes.
class RowCounter {
 public:
  /// `before` is done before the present pass, `after` with its rows.
  RowCounter(double before, double after, int rows, const Progress& progress)
      : before_(before), after_(after), rows_(rows), progress_(progress) {}

  void add() {
    const std::scoped_lock lock(mutex_);
    ++done_;
    if (progress_) progress_(std::lerp(before_, after_, static_cast<double>(done_) / rows_));
  }

 private:
  double before_;
  double after_;
  int rows_;
  int done_ = 0;
  const Progress& progress_;
  std::mutex mutex_;
};

}  // namespace weft
