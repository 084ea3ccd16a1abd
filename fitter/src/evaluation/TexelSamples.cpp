#include "weft/evaluation/TexelSamples.h"

#include <algorithm>
#include <cmath>

#include "weft/core/BatchEncoding.h"

namespace weft {

TexelSamples texelSamples(const BtfDescription& measured, std::span<const SamplePlace> places) {
  const std::size_t pairs = measured.views.size() * measured.lights.size();
  const std::size_t each = pairs / places.size();
  const bool areAsStored = measured.storedAsBytes && measured.cosineInData;
  TexelSamples samples{std::vector<glm::vec3>(pairs), std::vector<glm::vec3>(pairs)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [rows, row, column] = places[i];
    rows->linear(row, column, std::span(samples.linear).subspan(i * each, each), i * each);
    if (areAsStored) rows->stored(row, column, std::span(samples.stored).subspan(i * each, each), i * each);
  }
  if (areAsStored) return samples;
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
