#include "EnvironmentReference.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "weft/reflectance/CosineLobe.h"

namespace weft {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

float roundedExponent(float exponent) {
  return std::exp2(0.5f * std::clamp(std::round(2.0f * std::log2(exponent)), 0.0f, 10.0f));
}

float powerOf(float cosine, float exponent) {
  return cosine > 0.0f ? std::pow(cosine, exponent) : 0.0f;
}

}  // namespace

EnvironmentReference::EnvironmentReference(const Environment& environment) {
  for (int y = 0; y < environment.height(); ++y)
    for (int x = 0; x < environment.width(); ++x)
      texels_.push_back({environment.direction(x, y),
                         static_cast<float>(environment.solidAngle(y)) * environment.texel(x, y)});
}

template <class Kernel>
glm::vec3 EnvironmentReference::sum(const Kernel& kernel) const {
  glm::vec3 total(0.0f);
  for (const Texel& texel : texels_) total += kernel(texel.direction) * texel.light;
  return total;
}

glm::vec3 EnvironmentReference::shown(const glm::mat3& axes,
                                      const std::function<glm::vec3(glm::vec3)>& value) const {
  const glm::mat3 toFrame = glm::transpose(axes);
  return sum([&](glm::vec3 direction) {
           const glm::vec3 light = toFrame * direction;
           return light.z > 0.0f ? value(light) : glm::vec3(0.0f);
         }) /
         kPi;
}

glm::vec3 EnvironmentReference::Light::diffuse(glm::vec3 normal) const {
  const glm::vec3 n = axes_ * normal;
  return reference_.sum([&](glm::vec3 l) { return std::max(glm::dot(n, l), 0.0f); }) / kPi;
}

glm::vec3 EnvironmentReference::Light::average(glm::vec3 t, float exponent) const {
  const glm::vec3 axis = axes_ * t;
  if (method_ == LobeMethod::PaperRounded) exponent = roundedExponent(exponent);
  return (exponent + 1.0f) / (2.0f * kPi) *
         reference_.sum([&](glm::vec3 l) { return powerOf(glm::dot(axis, l), exponent); });
}

glm::vec3 EnvironmentReference::Light::lobe(glm::vec3 t, float exponent) const {
  const glm::vec3 normal(0, 0, 1);
  switch (method_) {
    case LobeMethod::True: {
      const glm::vec3 axis = axes_ * t, n = axes_[2];
      return reference_.sum([&](glm::vec3 l) {
        const float facing = glm::dot(n, l);
        return facing > 0.0f ? facing * powerOf(glm::dot(axis, l), exponent) : 0.0f;
      }) / kPi;
    }
    case LobeMethod::PaperRounded:
      exponent = roundedExponent(exponent);
      [[fallthrough]];
    case LobeMethod::Paper:
      return 2.0f / (exponent + 1.0f) * std::max(t.z, 0.0f) * average(t, exponent);
    case LobeMethod::Shifted: {
      const float facing = std::max(t.z, 0.1f);
      const glm::vec3 leant = glm::normalize(t + (normal - t.z * t) / ((exponent + 1.0f) * facing));
      return 2.0f / (exponent + 2.0f) * std::max(t.z, 0.0f) * average(leant, exponent + 1.0f);
    }
    case LobeMethod::Fitted: {
      const CosineLobe lobe = lobeAboveHorizon(t, exponent, normal);
      return lobe.amount * average(lobe.direction, lobe.exponent);
    }
  }
  return glm::vec3(0.0f);
}

std::array<glm::vec3, 6> EnvironmentReference::Light::moments() const {
  std::array<glm::vec3, 6> moments{};
  const glm::mat3 toFrame = glm::transpose(axes_);
  for (const Texel& texel : reference_.texels_) {
    const glm::vec3 l = toFrame * texel.direction;
    if (l.z <= 0.0f) continue;
    const std::array<float, 6> weights{l.x * l.x, l.y * l.y, l.x * l.y, l.x, l.y, 1.0f};
    for (std::size_t i = 0; i < 6; ++i) moments[i] += l.z * weights[i] / kPi * texel.light;
  }
  return moments;
}

glm::vec3 EnvironmentReference::Light::glossy(glm::vec3 normal, glm::vec3 view, float roughness,
                                              float f0) const {
  const glm::vec3 mirrored = axes_ * (2.0f * glm::dot(normal, view) * normal - view);
  const float squared = std::pow(roughness, 4.0f);
  const auto kernel = [&](float cosine) {
    if (cosine <= 0.0f) return 0.0f;
    const float width = 0.5f * (1.0f + cosine) * (squared - 1.0f) + 1.0f;
    return cosine / (width * width);
  };
  constexpr int kSteps = 512;
  float whole = 0.0f;
  for (int i = 0; i < kSteps; ++i) {
    const float angle = 0.5f * kPi * (static_cast<float>(i) + 0.5f) / kSteps;
    whole += 0.5f * kPi / kSteps * 2.0f * kPi * std::sin(angle) * kernel(std::cos(angle));
  }
  return glossyShare(normal, view, roughness, f0) / whole *
         reference_.sum([&](glm::vec3 l) { return kernel(glm::dot(mirrored, l)); });
}

float EnvironmentReference::Light::glossyShare(glm::vec3 normal, glm::vec3 view, float roughness,
                                               float f0) const {
  const glm::vec2 shares = reference_.microfacets_.at(std::abs(glm::dot(normal, view)), roughness);
  return f0 * shares.x + shares.y;
}

}  // namespace weft
