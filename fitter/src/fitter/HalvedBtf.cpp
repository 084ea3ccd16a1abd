#include "HalvedBtf.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "weft/core/BatchEncoding.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {
namespace {

bool isNone(glm::vec3 sample) {
  return !std::isfinite(sample.x + sample.y + sample.z);
}

// The samples of one texel among those of rows.
template <class Sample>
std::span<Sample> samplesAt(std::span<Sample> all, const SampleRows& rows, int row, int column) {
  const std::size_t texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(rows.columns()) +
                            static_cast<std::size_t>(column);
  return all.subspan(texel * rows.pairs() * 3, rows.pairs() * 3);
}

}  // namespace

HalvedBtf::HalvedBtf(const BtfSource& finer, const Crop& crop, std::size_t memory)
    : finer_(finer), crop_(crop), memory_(memory), description_(finer.description()) {
  description_.width = sideOfLevel(crop.width, 1);
  description_.height = sideOfLevel(crop.height, 1);
}

std::size_t HalvedBtf::bytes() const {
  return description_.rowBytes() * static_cast<std::size_t>(description_.height);
}

BoxCover HalvedBtf::finerRows(int row) const {
  return boxCover(row, description_.height, crop_.height);
}

Result<void> HalvedBtf::readRows(int firstRow, int rowCount, SampleRows& out) const {
  WEFT_TRY_VOID(out.allocate(description_, rowCount));
  if (kept_.rows() > 0) {
    copyRows(firstRow, rowCount, out);
    return {};
  }
  const int atOnce = std::max(finer_.rowsWithin(memory_ / 4) / 2 - 1, 1);
  SampleWindow window;
  for (int done = 0; done < rowCount; done += atOnce) {
    const int count = std::min(atOnce, rowCount - done);
    const BoxCover top = finerRows(firstRow + done), bottom = finerRows(firstRow + done + count - 1);
    const int end = bottom.first + static_cast<int>(bottom.shares.size());
    WEFT_TRY_VOID(window.read(finer_, crop_, top.first, end - top.first, 0));
    for (int row = done; row < done + count; ++row) average(window, firstRow + row, row, out);
  }
  return {};
}

void HalvedBtf::copyRows(int firstRow, int rowCount, SampleRows& out) const {
  const auto copy = [&](auto from, auto to) {
    const std::size_t ofRow = from.size() / static_cast<std::size_t>(description_.height);
    std::ranges::copy(
        from.subspan(static_cast<std::size_t>(firstRow) * ofRow, static_cast<std::size_t>(rowCount) * ofRow),
        to.begin());
  };
  description_.storedAsBytes ? copy(kept_.bytes(), out.bytes()) : copy(kept_.floats(), out.floats());
}

Result<void> HalvedBtf::keep() {
  if (kept_.rows() > 0 || bytes() > memory_ / 2) return {};
  SampleRows all;
  WEFT_TRY_VOID(readRows(0, description_.height, all));
  kept_ = std::move(all);
  return {};
}

Result<void> HalvedBtf::keepFrom(const SampleWindow& finer) {
  const std::size_t finerBytes = finer_.description().rowBytes() * static_cast<std::size_t>(crop_.height);
  if (finerBytes + bytes() > memory_) return {};
  SampleRows all;
  WEFT_TRY_VOID(all.allocate(description_, description_.height));
  for (int row = 0; row < description_.height; ++row) average(finer, row, row, all);
  kept_ = std::move(all);
  return {};
}

void HalvedBtf::average(const SampleWindow& finer, int row, int toRow, SampleRows& out) const {
  const BoxCover rows = finerRows(row);
  tbb::parallel_for(0, description_.width, [&](int column) {
    std::vector<glm::vec3> samples = averageOf(finer, rows, column);
    const std::span<float> values = floatsOf(samples);
    if (!description_.storedAsBytes) {
      std::ranges::copy(values, samplesAt(out.floats(), out, toRow, column).begin());
      return;
    }
    encodeAll(description_.encoding, values);
    std::ranges::transform(values, samplesAt(out.bytes(), out, toRow, column).begin(),
                           [](float value) { return static_cast<std::uint8_t>(255.0f * value + 0.5f); });
  });
}

std::vector<glm::vec3> HalvedBtf::averageOf(const SampleWindow& finer, const BoxCover& rows,
                                            int column) const {
  const BoxCover columns = boxCover(column, description_.width, crop_.width);
  const std::size_t pairs = description_.views.size() * description_.lights.size();
  std::vector<glm::vec3> sum(pairs, glm::vec3(0.0f)), samples(pairs);
  const std::span<float> sums = floatsOf(sum), values = floatsOf(samples);
  for (std::size_t j = 0; j < rows.shares.size(); ++j) {
    const auto [read, row] = finer.find(rows.first + static_cast<int>(j));
    for (std::size_t i = 0; i < columns.shares.size(); ++i) {
      read->linear(row, crop_.x + columns.first + static_cast<int>(i), samples);
      // They count as black, as everywhere.
      if (!description_.storedAsBytes) std::ranges::replace_if(samples, isNone, glm::vec3(0.0f));
      const float share = rows.shares[j] * columns.shares[i];
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += share * values[k];
    }
  }
  return sum;
}

}  // namespace weft
