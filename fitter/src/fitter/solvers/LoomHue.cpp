#include "solvers/LoomHue.h"

#include <tbb/parallel_for.h>

#include <array>

#include "FitWeights.h"

namespace weft {
namespace {

/// Sums of a least squares problem of two unknowns.
struct TwoUnknowns {
  double aa = 0, ab = 0, bb = 0, a = 0, b = 0;

  void add(double squaredWeight, float first, float second, float value) {
    aa += squaredWeight * first * first;
    ab += squaredWeight * first * second;
    bb += squaredWeight * second * second;
    a += squaredWeight * first * value;
    b += squaredWeight * second * value;
  }
  std::array<float, 2> solution() const {
    constexpr double kRidge = 1e-4;  // of texels whose two weights say the same
    const double ridge = kRidge * (aa + bb), p = aa + ridge, q = bb + ridge;
    const double determinant = p * q - ab * ab;
    if (!(determinant > 0.0)) return {0.0f, 0.0f};
    return {static_cast<float>((q * a - ab * b) / determinant),
            static_cast<float>((p * b - ab * a) / determinant)};
  }
};

float squared(float value) {
  return value * value;
}

}  // namespace

std::vector<float> fitHue(std::span<const glm::vec3> samples, std::span<const float> basis,
                          std::span<const float> weights, std::size_t components, bool weighted) {
  const std::size_t pairs = basis.size() / components, texels = samples.size() / pairs;
  std::vector<glm::vec3> baseColors(texels);
  tbb::parallel_for(std::size_t{0}, texels, [&](std::size_t texel) {
    const auto ofTexel = samples.subspan(texel * pairs, pairs);
    baseColors[texel] = weighted ? fitBaseColor(ofTexel) : fitPlainBaseColor(ofTexel);
  });
  std::vector<float> hues(4 * pairs);
  tbb::parallel_for(std::size_t{0}, pairs, [&](std::size_t pair) {
    TwoUnknowns red, blue;
    for (std::size_t texel = 0; texel < texels; ++texel) {
      const float* w = weights.data() + texel * components;
      const glm::vec3 sample = samples[texel * pairs + pair];
      float y = 0.0f;
      for (std::size_t k = 0; k < components; ++k) y += w[k] * basis[pair * components + k];
      const glm::vec3 rest = sample - y * baseColors[texel];
      red.add(weighted ? squared(displayWeight(sample.r)) : 1.0f, w[0], w[1], rest.r);
      blue.add(weighted ? squared(displayWeight(sample.b)) : 1.0f, w[0], w[1], rest.b);
    }
    const auto [red0, red1] = red.solution();
    const auto [blue0, blue1] = blue.solution();
    float* hue = hues.data() + 4 * pair;
    hue[0] = red0, hue[1] = red1, hue[2] = blue0, hue[3] = blue1;
  });
  return hues;
}

}  // namespace weft
