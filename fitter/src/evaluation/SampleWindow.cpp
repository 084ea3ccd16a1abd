#include "weft/evaluation/SampleWindow.h"

#include <algorithm>

#include "weft/core/Contract.h"

namespace weft {

Result<void> SampleWindow::read(const BtfSource& source, const Crop& crop, int first, int count, int halo) {
  height_ = crop.height;
  const int from = first - halo, to = first + count + halo;
  std::array<std::pair<int, int>, 3> ranges{};  // first row and one past the last
  if (to - from >= height_)
    ranges[1] = {0, height_};
  else
    ranges = {{{std::min(from, 0) + height_, height_},
               {std::max(from, 0), std::min(to, height_)},
               {0, std::max(to - height_, 0)}}};
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    part.first = ranges[i].first;
    part.count = std::max(ranges[i].second - ranges[i].first, 0);
    if (part.count > 0) WEFT_TRY_VOID(source.readRows(crop.y + part.first, part.count, part.rows));
  }
  return {};
}

std::pair<const SampleRows*, int> SampleWindow::find(int row) const {
  row = (row % height_ + height_) % height_;
  for (const Part& part : parts_)
    if (row >= part.first && row < part.first + part.count) return {&part.rows, row - part.first};
  WEFT_EXPECT(false, "the row was read");
  return {};
}

}  // namespace weft
