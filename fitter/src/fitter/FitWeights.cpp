#include "FitWeights.h"

#include <algorithm>
#include <cmath>

#include "weft/core/BatchEncoding.h"

namespace weft {
namespace {

// The square of displayWeight().
float squaredWeight(float value) {
  // The slope of y^(1/2.2) is y^-0.55; 0.01 is about where a display's black begins.
  return 1.0f / (std::max(value, 0.0f) + 0.01f);
}

// Sums of floats over runs of samples, which are then added up in double.
template <class Weight>
glm::vec3 baseColorOf(std::span<const glm::vec3> samples, const Weight& weight) {
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

std::vector<float> displayWeights(std::span<const float> values) {
  std::vector<float> weights(values.size());
#pragma omp simd
  for (std::size_t i = 0; i < values.size(); ++i) weights[i] = std::sqrt(squaredWeight(values[i]));
  return weights;
}

glm::vec3 fitBaseColor(std::span<const glm::vec3> samples) {
  return baseColorOf(samples, squaredWeight);
}

glm::vec3 fitPlainBaseColor(std::span<const glm::vec3> samples) {
  return baseColorOf(samples, [](float) { return 1.0f; });
}

FitTargets luminanceTargets(std::span<const glm::vec3> linear, std::span<const glm::vec3> displayed,
                            Encoding display, glm::vec3 baseColor) {
  const float baseDisplayed = luminance(encode(display, baseColor));
  FitTargets targets;
  targets.values.resize(linear.size());
#pragma omp simd
  for (std::size_t i = 0; i < linear.size(); ++i) targets.values[i] = luminance(displayed[i]) / baseDisplayed;
  decodeAll(display, targets.values);
#pragma omp simd
  for (std::size_t i = 0; i < linear.size(); ++i)
    targets.values[i] = std::sqrt(std::max(luminance(linear[i]), 0.0f) * targets.values[i]);
  targets.weights = displayWeights(targets.values);
  return targets;
}

FitTargets plainLuminanceTargets(std::span<const glm::vec3> stored) {
  FitTargets targets;
  targets.values.reserve(stored.size());
  for (glm::vec3 sample : stored) targets.values.push_back(luminance(sample));
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
