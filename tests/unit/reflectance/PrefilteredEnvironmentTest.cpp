#include "weft/reflectance/PrefilteredEnvironment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "TestSupport.h"

namespace weft::test {
namespace {

constexpr double kPi = std::numbers::pi;

// The sum over all texels of an environment.
glm::dvec3 integral(const Environment& environment, const std::function<double(glm::vec3 l)>& kernel) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < environment.height(); ++y)
    for (int x = 0; x < environment.width(); ++x)
      sum += environment.solidAngle(y) * kernel(environment.direction(x, y)) *
             glm::dvec3(environment.texel(x, y));
  return sum;
}

glm::dvec3 texelOf(const FloatImage& image, int x, int y, int layer, float scale) {
  const auto rgb = image.texel(x + 1, y + 1, layer);
  return static_cast<double>(scale) * glm::dvec3(rgb[0], rgb[1], rgb[2]);
}

void expectClose(glm::dvec3 actual, glm::dvec3 expected, double relative, double absolute) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], relative * std::abs(expected[c]) + absolute) << "channel " << c;
}

class Prefiltered : public testing::TestWithParam<const char*> {};

TEST_P(Prefiltered, EqualsSumsOverAllTexels) {
  const Environment environment = valueOf(Environment::builtin(GetParam())).reduced(128, 64);
  const PrefilteredEnvironment filtered = PrefilteredEnvironment::create(environment);
  // Errors of what is dark beside a sun are in proportion to what is bright.
  const double mean = integral(environment, [](glm::vec3) { return 1.0; }).y / (4.0 * kPi);
  const OctahedralMap map = PrefilteredEnvironment::kLobeMap;
  for (const glm::ivec2 texel : {glm::ivec2(0, 0), {95, 96}, {130, 40}, {10, 150}, {191, 90}, {100, 101}}) {
    const glm::vec3 t = map.direction(texel.x, texel.y);
    for (const int layer : {0, 1, 4, 13, 20, 28, 32}) {
      SCOPED_TRACE(layer);
      const double n = std::exp2(layer / 4.0);
      expectClose(
          texelOf(filtered.lobes, texel.x, texel.y, layer, filtered.scale),
          (n + 1.0) / (2.0 * kPi) *
              integral(environment, [&](glm::vec3 l) { return std::pow(std::max(glm::dot(t, l), 0.0f), n); }),
          2e-3, 4e-3 * mean);
    }
    const std::function<double(glm::vec3)> weights[] = {
        [](glm::vec3) { return 1.0; },         [](glm::vec3 l) { return l.x; },
        [](glm::vec3 l) { return l.y; },       [](glm::vec3 l) { return l.z; },
        [](glm::vec3 l) { return l.x * l.x; }, [](glm::vec3 l) { return l.y * l.y; },
        [](glm::vec3 l) { return l.z * l.z; }, [](glm::vec3 l) { return l.x * l.y; },
        [](glm::vec3 l) { return l.x * l.z; }, [](glm::vec3 l) { return l.y * l.z; }};
    for (int layer = 0; layer < PrefilteredEnvironment::kMomentLayers; ++layer) {
      SCOPED_TRACE(layer);
      expectClose(texelOf(filtered.moments, texel.x, texel.y, layer, filtered.scale),
                  1.0 / kPi *
                      integral(environment,
                               [&](glm::vec3 l) {
                                 return std::max(glm::dot(t, l), 0.0f) *
                                        weights[static_cast<std::size_t>(layer)](l);
                               }),
                  2e-3, 4e-3 * mean);
    }
  }
  const OctahedralMap glossyMap = PrefilteredEnvironment::kGlossyMap;
  for (const glm::ivec2 texel : {glm::ivec2(0, 0), {130, 40}, {10, 150}, {255, 200}}) {
    const glm::vec3 t = glossyMap.direction(texel.x, texel.y);
    for (const int layer : {3, 4, 6, 9, 12}) {
      SCOPED_TRACE(layer);
      const double squared = std::pow(layer / 12.0, 4.0);
      const auto kernel = [&](glm::vec3 l) {
        const double cosine = glm::dot(t, l);
        const double h = 0.5 * (1.0 + cosine);  // cosine of half the angle, squared
        return cosine > 0.0 ? cosine / std::pow(h * (squared - 1.0) + 1.0, 2.0) : 0.0;
      };
      double norm = 0.0;
      for (int i = 0; i < 20000; ++i) {
        const double angle = 0.5 * kPi * (i + 0.5) / 20000;
        const double h = 0.5 * (1.0 + std::cos(angle));
        norm += 0.5 * kPi / 20000 * 2.0 * kPi * std::sin(angle) * std::cos(angle) /
                std::pow(h * (squared - 1.0) + 1.0, 2.0);
      }
      expectClose(texelOf(filtered.glossy, texel.x, texel.y, layer, filtered.scale),
                  1.0 / norm * integral(environment, kernel), 1e-2, 1e-2 * mean);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Builtin, Prefiltered, testing::Values("studio", "sky"));

}  // namespace
}  // namespace weft::test
