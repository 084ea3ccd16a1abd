#include "weft/evaluation/TexelRun.h"

#include <algorithm>

namespace weft {

TexelRun::TexelRun(const SampledRow& row, int run)
    : row_(row),
      x_(run * kTexels),
      measured_(static_cast<std::size_t>(std::min(kTexels, row.width - x_))),
      fitted_(measured_.size()) {}

const TexelSamples& TexelRun::measured(int texel) {
  std::optional<TexelSamples>& samples = measured_[static_cast<std::size_t>(texel)];
  if (!samples)
    samples = texelSamples(row_.samples, row_.measured, row_.sampleRow, row_.firstColumn + x_ + texel);
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
