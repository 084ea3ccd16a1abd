#include "weft/evaluation/TexelSamples.h"

#include <algorithm>
#include <cmath>

#include "weft/core/BatchEncoding.h"

namespace weft {

TexelSamples texelSamples(const SampleRows& rows, const BtfDescription& measured, int row, int column) {
  TexelSamples samples{std::vector<glm::vec3>(rows.pairs()), std::vector<glm::vec3>(rows.pairs())};
  rows.linear(row, column, samples.linear);
  if (measured.storedAsBytes && measured.cosineInData) {
    rows.stored(row, column, samples.stored);
    return samples;
  }
  const std::size_t lights = measured.lights.size();
  for (std::size_t i = 0; i < samples.linear.size(); ++i) {
    glm::vec3& sample = samples.linear[i];
    if (!std::isfinite(sample.x + sample.y + sample.z)) sample = glm::vec3(0.0f);
    if (!measured.cosineInData) sample *= std::max(measured.lights[i % lights].z, 0.0f);
  }
  samples.stored = samples.linear;
  encodeAll(measured.encoding, floatsOf(samples.stored));
  return samples;
}

}  // namespace weft
