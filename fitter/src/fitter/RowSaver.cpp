#include "RowSaver.h"

namespace weft {

RowSaver::RowSaver(PassRows& rows, double seconds, const std::function<void(const std::string&)>& warn)
    : rows_(rows),
      pause_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))),
      warn_(warn),
      thread_([this](const std::stop_token& stop) { saveUntilStopped(stop); }) {}

RowSaver::~RowSaver() = default;

void RowSaver::wake() {
  {
    const std::scoped_lock lock(mutex_);
    hasNews_ = true;
  }
  changed_.notify_one();
}

void RowSaver::saveUntilStopped(const std::stop_token& stop) {
  Clock::time_point next = Clock::now() + pause_;
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return hasNews_; })) {
    changed_.wait_until(lock, stop, next, [] { return false; });
    if (stop.stop_requested()) return;
    hasNews_ = false;
    lock.unlock();
    tryToSave();
    next = Clock::now() + pause_;
    lock.lock();
  }
}

void RowSaver::tryToSave() {
  const Result<void> saved = rows_.save();
  if (saved || hasWarned_ || !warn_) return;
  hasWarned_ = true;
  warn_(saved.error().message() + "; the fit goes on, a stop would lose its rows");
}

Result<void> RowSaver::finish() {
  thread_.request_stop();
  thread_.join();
  return pause_ == Clock::duration::zero() ? rows_.save() : Result<void>();
}

}  // namespace weft
