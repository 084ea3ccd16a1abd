#include "weft/evaluation/RawBtf.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

/// The cosine of 84 degrees.
constexpr float kLowestDivisor = 0.1f;

/// Samples of some rows and columns of others, in memory of their own.
Result<void> copySamples(const SampleRows& from, int firstRow, int firstColumn,
                         const BtfDescription& description, int rows, SampleRows& to) {
  WEFT_TRY_VOID(to.allocate(description, rows));
  const auto copyRow = [&](auto source, auto target, int row) {
    const std::size_t texel = 3 * from.pairs();
    const std::size_t first =
        (static_cast<std::size_t>(firstRow + row) * static_cast<std::size_t>(from.columns()) +
         static_cast<std::size_t>(firstColumn)) *
        texel;
    const std::size_t count = static_cast<std::size_t>(description.width) * texel;
    std::ranges::copy(source.subspan(first, count),
                      target.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * count));
  };
  for (int row = 0; row < rows; ++row)
    if (description.storedAsBytes)
      copyRow(from.bytes(), to.bytes(), row);
    else
      copyRow(from.floats(), to.floats(), row);
  return {};
}

}  // namespace

Result<RawBtf> RawBtf::read(const BtfSource& source, const std::optional<Crop>& crop) {
  RawBtf btf;
  btf.description_ = source.description();
  WEFT_TRY(btf.views_, HemisphereTriangulation::create(btf.description_.views));
  WEFT_TRY(btf.lights_, HemisphereTriangulation::create(btf.description_.lights));
  WEFT_TRY(const Crop texels, checkedCrop(crop, btf.description_));
  btf.description_.width = texels.width;
  btf.description_.height = texels.height;
  if (texels.width == source.description().width) {
    WEFT_TRY_VOID(source.readRows(texels.y, texels.height, btf.samples_));
    return btf;
  }
  SampleRows whole;
  WEFT_TRY_VOID(source.readRows(texels.y, texels.height, whole));
  WEFT_TRY_VOID(copySamples(whole, 0, texels.x, btf.description_, texels.height, btf.samples_));
  return btf;
}

Result<void> RawBtf::readRows(int firstRow, int rowCount, SampleRows& out) const {
  return copySamples(samples_, firstRow, 0, description_, rowCount, out);
}

glm::vec3 RawBtf::evaluate(int x, int y, glm::vec3 light, glm::vec3 view) const {
  if (!(light.z > 0.0f)) return glm::vec3(0.0f);
  const DirectionWeights views = views_.locate(view);
  const DirectionWeights lights = lights_.locate(light);
  glm::vec3 sum(0.0f);
  for (int j = 0; j < 3; ++j) {
    const auto lightIndex = static_cast<std::size_t>(lights.index[static_cast<std::size_t>(j)]);
    const float measuredZ = description_.lights[lightIndex].z;
    float lightWeight = lights.weight[j];
    if (!description_.cosineInData)
      lightWeight *= light.z;
    else if (measuredZ > kLowestDivisor)
      lightWeight *= light.z / measuredZ;
    if (lightWeight == 0.0f) continue;
    for (int i = 0; i < 3; ++i) {
      if (views.weight[i] == 0.0f) continue;
      const auto viewIndex = static_cast<std::size_t>(views.index[static_cast<std::size_t>(i)]);
      std::array<glm::vec3, 1> sample;
      samples_.linear(y, x, sample, viewIndex * description_.lights.size() + lightIndex);
      if (std::isfinite(sample[0].x + sample[0].y + sample[0].z))
        sum += lightWeight * views.weight[i] * sample[0];
    }
  }
  return sum;
}

OneViewBtf::OneViewBtf(const RawBtf& raw, glm::vec3 view, std::vector<glm::vec3> lights)
    : raw_(raw), description_(raw.description()) {
  description_.views = {view};
  description_.lights = std::move(lights);
  description_.storedAsBytes = false;
  description_.cosineInData = true;
}

Result<void> OneViewBtf::readRows(int firstRow, int rowCount, SampleRows& out) const {
  WEFT_TRY_VOID(out.allocate(description_, rowCount));
  const std::span<float> values = out.floats();
  tbb::parallel_for(0, rowCount, [&](int row) {
    std::size_t next = static_cast<std::size_t>(row) * (values.size() / static_cast<std::size_t>(rowCount));
    for (int x = 0; x < description_.width; ++x)
      for (const glm::vec3 light : description_.lights) {
        const glm::vec3 rgb = raw_.evaluate(x, firstRow + row, light, description_.views[0]);
        for (int channel = 0; channel < 3; ++channel) values[next++] = rgb[channel];
      }
  });
  return {};
}

}  // namespace weft
