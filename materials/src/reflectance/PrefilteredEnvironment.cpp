#include "weft/reflectance/PrefilteredEnvironment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "SphericalHarmonics.h"

namespace weft {
namespace {

/// Enough for (t.l)^256: the harmonics of that degree are 4e-5 of the first.
constexpr int kDegree = 72;
/// Below this layer, mirrors too smooth for the harmonics are sampled.
constexpr int kFirstSmoothGlossy = 3;
constexpr float kLargestStored = 32768.0f;

double roughnessOf(int layer) {
  return static_cast<double>(layer) / (PrefilteredEnvironment::kGlossyLayers - 1);
}

/// Microfacets of GGX as they are seen head-on: light at `cosine` is reflected where they lean half
/// as far.
double glossyKernel(double roughness, double cosine) {
  if (cosine <= 0.0) return 0.0;
  const double squared = std::pow(roughness, 4.0);
  const double facing = 0.5 * (1.0 + cosine);  // the square of the cosine of half the angle
  const double width = facing * (squared - 1.0) + 1.0;
  return squared / (width * width) * cosine;
}

/// The environment in halves, as filtered lookups need it.
class Pyramid {
 public:
  explicit Pyramid(const Environment& environment) : levels_{environment} {
    while (levels_.back().height() > 4)
      levels_.push_back(levels_.back().reduced(levels_.back().width() / 2, levels_.back().height() / 2));
  }

  /// The radiance around a direction, over about so many steradians.
  glm::vec3 around(glm::vec3 direction, double solidAngle) const {
    const double texel =
        4.0 * std::numbers::pi / (static_cast<double>(levels_[0].width()) * levels_[0].height());
    const auto level = static_cast<float>(std::clamp(0.5 * std::log2(std::max(solidAngle / texel, 1.0)), 0.0,
                                                     static_cast<double>(levels_.size() - 1)));
    const auto low = std::min(static_cast<std::size_t>(level), levels_.size() - 1);
    const auto high = std::min(low + 1, levels_.size() - 1);
    const glm::vec2 place = Environment::place(direction);
    return glm::mix(levels_[low].bilinear(place), levels_[high].bilinear(place),
                    level - static_cast<float>(low));
  }

 private:
  std::vector<Environment> levels_;
};

/// The kernel's average around a direction, sampled where the kernel is large, each sample as wide
/// as the samples are apart.
glm::vec3 sampledGlossy(const Pyramid& pyramid, glm::vec3 direction, double roughness) {
  if (roughness == 0.0)
    return pyramid.around(direction,
                          4.0 * std::numbers::pi / std::pow(PrefilteredEnvironment::kGlossyMap.size, 2));
  constexpr int kSamples = 64;
  const double squared = std::pow(roughness, 4.0);
  const glm::vec3 other = std::abs(direction.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 across = glm::normalize(glm::cross(direction, other));
  const glm::vec3 along = glm::cross(direction, across);
  glm::vec3 sum(0.0f);
  float weights = 0.0f;
  for (int i = 0; i < kSamples; ++i) {
    const double u = (i + 0.5) / kSamples;
    const double facing = (1.0 - u) / (1.0 + (squared - 1.0) * u);
    const double cosine = 2.0 * facing - 1.0;
    if (cosine <= 0.0) continue;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const double phi = 2.399963229728653 * i;  // the golden angle: a sunflower's seeds
    const glm::vec3 l = static_cast<float>(cosine) * direction +
                        static_cast<float>(sine * std::cos(phi)) * across +
                        static_cast<float>(sine * std::sin(phi)) * along;
    const double width = facing * (squared - 1.0) + 1.0;
    // Per steradian of l.
    const double density = squared / (std::numbers::pi * width * width) / 4.0;
    sum += static_cast<float>(cosine) * pyramid.around(l, 1.0 / (kSamples * density));
    weights += static_cast<float>(cosine);
  }
  return sum / weights;
}

void sampleSmoothLayers(const Environment& environment, FloatImage& glossy) {
  const Pyramid pyramid(environment);
  const OctahedralMap map = PrefilteredEnvironment::kGlossyMap;
  tbb::parallel_for(0, map.size, [&](int y) {
    for (int layer = 0; layer < kFirstSmoothGlossy; ++layer)
      for (int x = 0; x < map.size; ++x) {
        const glm::vec3 radiance = sampledGlossy(pyramid, map.direction(x, y), roughnessOf(layer));
        for (int c = 0; c < 3; ++c) glossy.at(x + 1, y + 1, c, layer) = radiance[c];
      }
  });
  map.fillBorder(glossy);
}

using Weight = std::function<float(glm::vec3)>;

std::vector<Weight> momentWeights() {
  return {[](glm::vec3) { return 1.0f; },        [](glm::vec3 l) { return l.x; },
          [](glm::vec3 l) { return l.y; },       [](glm::vec3 l) { return l.z; },
          [](glm::vec3 l) { return l.x * l.x; }, [](glm::vec3 l) { return l.y * l.y; },
          [](glm::vec3 l) { return l.z * l.z; }, [](glm::vec3 l) { return l.x * l.y; },
          [](glm::vec3 l) { return l.x * l.z; }, [](glm::vec3 l) { return l.y * l.z; }};
}

/// Radiance is not negative, what harmonics make of it may be.
void clampAtZero(FloatImage& image) {
  for (float& value : image.values()) value = std::max(value, 0.0f);
}

void divideAndRound(FloatImage& image, float scale) {
  for (float& value : image.values()) value /= scale;
  image.roundToHalf();
}

}  // namespace

PrefilteredEnvironment PrefilteredEnvironment::create(const Environment& environment) {
  const SphericalHarmonics harmonics(kDegree);
  // The narrowest lobe is 7 degrees wide: texels of 0.7 are points to it.
  const SphericalHarmonics::Matrix radiance =
      harmonics.coefficients(environment.reduced(512, 256).enlarged(), momentWeights());
  const auto zeros = [&](int layers) {
    return SphericalHarmonics::Matrix(SphericalHarmonics::Matrix::Zero(harmonics.count(), 3 * layers));
  };
  const auto normalised = [&](const std::function<double(double)>& kernel) {
    std::vector<double> factors = harmonics.zonal(kernel);
    for (const double whole = factors[0]; double& factor : factors) factor /= whole;
    return factors;
  };

  auto lobes = zeros(kLobeLayers);
  for (int layer = 0; layer < kLobeLayers; ++layer) {
    const double exponent = std::exp2(static_cast<double>(layer) / kLobesPerOctave);
    const auto lobe = [&](double cosine) { return cosine > 0.0 ? std::pow(cosine, exponent) : 0.0; };
    harmonics.scale(radiance, 0, normalised(lobe), lobes, 3 * layer);
  }
  auto moments = zeros(kMomentLayers);
  const std::vector<double> facing = normalised([](double cosine) { return std::max(cosine, 0.0); });
  for (int layer = 0; layer < kMomentLayers; ++layer)
    harmonics.scale(radiance, 3 * layer, facing, moments, 3 * layer);
  auto glossy = zeros(kGlossyLayers);
  for (int layer = kFirstSmoothGlossy; layer < kGlossyLayers; ++layer)
    harmonics.scale(radiance, 0,
                    normalised([&](double cosine) { return glossyKernel(roughnessOf(layer), cosine); }),
                    glossy, 3 * layer);

  PrefilteredEnvironment result;
  result.lobes = harmonics.onMap(lobes, kLobeMap);
  result.moments = harmonics.onMap(moments, kLobeMap);
  result.glossy = harmonics.onMap(glossy, kGlossyMap);
  sampleSmoothLayers(environment.reduced(1024, 512).enlarged(), result.glossy);
  clampAtZero(result.lobes);
  clampAtZero(result.glossy);

  float brightest = 0.0f;
  for (const FloatImage* image : {&result.lobes, &result.moments, &result.glossy})
    for (const float value : image->values()) brightest = std::max(brightest, std::abs(value));
  while (brightest / result.scale > kLargestStored) result.scale *= 2.0f;
  for (FloatImage* image : {&result.lobes, &result.moments, &result.glossy})
    divideAndRound(*image, result.scale);
  return result;
}

}  // namespace weft
