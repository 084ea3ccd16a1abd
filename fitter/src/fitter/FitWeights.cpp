#include "FitWeights.h"

#include <algorithm>
#include <cmath>

#include "weft/core/BatchEncoding.h"
#include "weft/core/CpuVersions.h"

namespace weft {
namespace {

// The square of displayWeight().
[[gnu::always_inline]] inline float squaredWeight(float value) {
  // The slope of y^(1/2.2) is y^-0.55; 0.01 is about where a display's black begins.
  return 1.0f / (std::max(value, 0.0f) + 0.01f);
}

// Sums of floats over runs of samples, which are then added up in double.
template <class Weight>
[[gnu::always_inline]] inline glm::vec3 baseColorOf(std::span<const glm::vec3> samples,
                                                    const Weight& weight) {
  constexpr std::size_t kRun = 256;
  glm::dvec3 weighted(0.0);
  double squares = 0.0;
  for (std::size_t first = 0; first < samples.size(); first += kRun) {
    const std::size_t end = std::min(first + kRun, samples.size());
    float red = 0.0f;
    float green = 0.0f;
    float blue = 0.0f;
    float square = 0.0f;
#pragma omp simd reduction(+ : red, green, blue, square)
    for (std::size_t i = first; i < end; ++i) {
      const float y = luminance(samples[i]);
      const float factor = weight(y) * y;
      red += factor * samples[i].x;
      green += factor * samples[i].y;
      blue += factor * samples[i].z;
      square += factor * y;
    }
    weighted += glm::dvec3(red, green, blue);
    squares += double{square};
  }
  return squares > 0.0 ? glm::vec3(weighted / squares) : glm::vec3(1.0f);
}

}  // namespace

float displayWeight(float value) {
  return std::sqrt(squaredWeight(value));
}

WEFT_CPU_VERSIONS
std::vector<float> displayWeights(std::span<const float> values) {
  std::vector<float> weights(values.size());
#pragma omp simd
  for (std::size_t i = 0; i < values.size(); ++i) weights[i] = std::sqrt(squaredWeight(values[i]));
  return weights;
}

WEFT_CPU_VERSIONS
glm::vec3 fitBaseColor(std::span<const glm::vec3> samples) {
  return baseColorOf(samples, squaredWeight);
}

WEFT_CPU_VERSIONS
glm::vec3 fitPlainBaseColor(std::span<const glm::vec3> samples) {
  return baseColorOf(samples, [](float) { return 1.0f; });
}

namespace {

WEFT_CPU_VERSIONS
void luminances(std::span<const glm::vec3> colors, float scale, std::span<float> values) {
#pragma omp simd
  for (std::size_t i = 0; i < colors.size(); ++i) values[i] = luminance(colors[i]) * scale;
}

// The geometric means of luminances and other values.
WEFT_CPU_VERSIONS
void meanWithLuminances(std::span<const glm::vec3> colors, std::span<float> values) {
#pragma omp simd
  for (std::size_t i = 0; i < colors.size(); ++i)
    values[i] = std::sqrt(std::max(luminance(colors[i]), 0.0f) * values[i]);
}

}  // namespace

FitTargets luminanceTargets(std::span<const glm::vec3> linear, std::span<const glm::vec3> displayed,
                            Encoding display, glm::vec3 baseColor) {
  const float baseDisplayed = luminance(encode(display, baseColor));
  FitTargets targets;
  targets.values.resize(linear.size());
  luminances(displayed, 1.0f / baseDisplayed, targets.values);
  decodeAll(display, targets.values);
  meanWithLuminances(linear, targets.values);
  targets.weights = displayWeights(targets.values);
  return targets;
}

FitTargets plainLuminanceTargets(std::span<const glm::vec3> stored) {
  FitTargets targets;
  targets.values.resize(stored.size());
  luminances(stored, 1.0f, targets.values);
  targets.weights.assign(stored.size(), 1.0f);
  return targets;
}

FitTargets channelTargets(std::span<const glm::vec3> samples, int channel, glm::vec3 baseColor,
                          bool weighted) {
  FitTargets targets;
  const float base = baseColor[channel];
  for (glm::vec3 sample : samples) {
    const float value = sample[channel];
    targets.values.push_back(base > 0.0f ? value / base : 0.0f);
    targets.weights.push_back(weighted ? displayWeight(value) * base : base);
  }
  return targets;
}

}  // namespace weft
