#include "weft/baking/HeightField.h"

#include <algorithm>

#include "weft/core/Contract.h"

namespace weft {

namespace {

int wrap(int index, int count) {
  const int remainder = index % count;
  return remainder < 0 ? remainder + count : remainder;
}

bool isLower(const HeightField::Sample& a, const HeightField::Sample& b) {
  return a.height < b.height;
}

}  // namespace

HeightField::HeightField(int columnCount, int rowCount, float sampleSpacing)
    : columns(columnCount), rows(rowCount), spacing(sampleSpacing) {
  WEFT_EXPECT(columns > 0 && rows > 0 && spacing > 0.0f, "a height field needs a positive size");
  samples.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
}

const HeightField::Sample& HeightField::atPeriodic(int column, int row) const {
  return at(wrap(column, columns), wrap(row, rows));
}

float HeightField::lowest() const {
  return std::min_element(samples.begin(), samples.end(), isLower)->height;
}

float HeightField::highest() const {
  return std::max_element(samples.begin(), samples.end(), isLower)->height;
}

void HeightField::centre() {
  double sum = 0.0;
  for (const Sample& sample : samples) sum += static_cast<double>(sample.height);
  const auto mean = static_cast<float>(sum / static_cast<double>(samples.size()));
  for (Sample& sample : samples) sample.height -= mean;
}

}  // namespace weft
