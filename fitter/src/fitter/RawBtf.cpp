#include "weft/fitter/RawBtf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

/// The cosine of 84 degrees.
constexpr float kLowestDivisor = 0.1f;

}  // namespace

Result<RawBtf> RawBtf::read(const BtfSource& source) {
  RawBtf btf;
  btf.description_ = source.description();
  WEFT_TRY(btf.views_, HemisphereTriangulation::create(btf.description_.views));
  WEFT_TRY(btf.lights_, HemisphereTriangulation::create(btf.description_.lights));
  WEFT_TRY_VOID(source.readRows(0, btf.description_.height, btf.samples_));
  return btf;
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

}  // namespace weft
