#include "PassRows.h"

#include <algorithm>

namespace weft {

PassRows::PassRows(const PartsFolder& folder, int pass, int height)
    : folder_(folder), pass_(pass), done_(static_cast<std::size_t>(height), false), saved_(done_) {}

bool PassRows::isDone(int row) const {
  const std::scoped_lock lock(mutex_);
  return done_[static_cast<std::size_t>(row)];
}

int PassRows::firstMissing() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<int>(std::ranges::find(done_, false) - done_.begin());
}

void PassRows::setDone(RowRange rows) {
  const std::scoped_lock lock(mutex_);
  std::fill_n(done_.begin() + rows.first, rows.count, true);
}

void PassRows::setSaved(RowRange rows) {
  const std::scoped_lock lock(mutex_);
  std::fill_n(saved_.begin() + rows.first, rows.count, true);
}

std::vector<RowRange> PassRows::unsavedRows() const {
  const std::scoped_lock lock(mutex_);
  std::vector<RowRange> ranges;
  for (std::size_t row = 0; row < done_.size(); ++row) {
    if (!done_[row] || saved_[row]) continue;
    const int number = static_cast<int>(row);
    if (ranges.empty() || ranges.back().first + ranges.back().count != number) ranges.push_back({number, 0});
    ++ranges.back().count;
  }
  return ranges;
}

Result<void> PassRows::save() {
  if (!folder_.keepsRows()) return {};
  for (const RowRange rows : unsavedRows()) {
    WEFT_TRY_VOID(folder_.write(pass_, rows, contentsOf(rows)));
    setSaved(rows);
  }
  return {};
}

Result<void> PassRows::load() {
  return folder_.read(pass_, static_cast<int>(done_.size()), largestContents(),
                      [&](RowRange rows, std::span<const std::byte> contents) {
                        if (!take(rows, contents)) return false;
                        setDone(rows);
                        setSaved(rows);
                        return true;
                      });
}

}  // namespace weft
