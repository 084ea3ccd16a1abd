#include "weft/evaluation/TexelRun.h"

#include <algorithm>

namespace weft {

TexelRun::TexelRun(const SampledRow& row, int run, int length)
    : row_(row),
      x_(run * length),
      measured_(static_cast<std::size_t>(std::min(length, row.crop.width - x_))),
      fitted_(measured_.size()) {}

TexelSamples TexelRun::samplesOf(int texel) const {
  const int x = x_ + texel, width = row_.crop.width;
  const auto placeAt = [&](int column, int row) {
    const auto [rows, rowInRows] = row_.samples.find(row);
    return SamplePlace{rows, rowInRows, row_.crop.x + (column % width + width) % width};
  };
  if (row_.registration.empty()) return texelSamples(row_.measured, placeAt(x, row_.y));
  std::vector<SamplePlace> places;
  for (const glm::ivec2 offset : row_.registration)
    places.push_back(placeAt(x - offset.x, row_.y + offset.y));
  return texelSamples(row_.measured, places);
}

const TexelSamples& TexelRun::measured(int texel) {
  std::optional<TexelSamples>& samples = measured_[static_cast<std::size_t>(texel)];
  if (!samples) samples = samplesOf(texel);
  return *samples;
}

const TexelSamples& TexelRun::fitted(int texel) {
  if (row_.pairs.areAll()) return measured(texel);
  std::optional<TexelSamples>& samples = fitted_[static_cast<std::size_t>(texel)];
  if (!samples) {
    const TexelSamples& all = measured(texel);
    samples = {row_.pairs.of(all.linear), row_.pairs.of(all.stored)};
  }
  return *samples;
}

}  // namespace weft
