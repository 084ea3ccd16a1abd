#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

FitOptions bumpOptions() {
  FitOptions options;
  options.model.name = "bump";
  options.precision = Precision::Float;
  return options;
}

struct Surface {
  float albedo;
  glm::vec3 normal;
  float roughness;
};

Surface surfaceAt(const ReflectanceField& field, int x) {
  const auto numbers = field.shared().texel(x, 0);
  return {numbers[3], directionFromParabolic({numbers[4], numbers[5]}), numbers[6]};
}

double degreesBetween(glm::vec3 a, glm::vec3 b) {
  return glm::degrees(std::asin(std::min(glm::length(glm::cross(a, b)), 1.0f)));
}

// Normals from upright to steep, all around.
constexpr int kNormals = 16;
glm::vec3 normalOf(int x) {
  return directionFromDegrees(3.0 * x, 77.0 * x);
}

// What bump is to recover, for one of the normals.
Surface glossySurface(int x) {
  return {0.2f + 0.05f * static_cast<float>(x % 7), normalOf(x), 0.4f + 0.1f * static_cast<float>(x % 5)};
}

float valueOfSurface(const Surface& surface, glm::vec3 view, glm::vec3 light) {
  static const auto model = valueOf(ModelRegistry::builtin().create({.name = "bump"}));
  const glm::vec2 p = parabolicFromDirection(surface.normal);
  return model->evaluate(std::array{surface.albedo, p.x, p.y, surface.roughness}, {}, light, view);
}

// A quarter of all lights, on one side; not where the highlight is, which alone tells the
// roughness.
bool isShadowed(int x, glm::vec3 light) {
  return glm::dot(light, directionFromDegrees(90.0, 77.0 * x + 120.0)) > 0.55f;
}

TEST(BumpFitter, RecoversLambertianNormalsInShadow) {
  const glm::vec3 color = glm::vec3(0.9f, 0.5f, 0.3f);
  for (const bool withShadows : {false, true}) {
    const MemoryBtf source(kNormals, 1, [&](int x, int, glm::vec3, glm::vec3 l) {
      const float shadow = withShadows && isShadowed(x, l) ? 0.1f : 1.0f;
      return 0.6f * shadow * std::max(glm::dot(normalOf(x), l), 0.0f) * color;
    });
    const FitResult fit = valueOf(fitReflectanceField(source, bumpOptions()));
    for (int x = 0; x < kNormals; ++x) {
      EXPECT_LT(degreesBetween(surfaceAt(fit.field, x).normal, normalOf(x)), 0.7) << x << " " << withShadows;
      EXPECT_NEAR(surfaceAt(fit.field, x).albedo, 0.6f * luminance(color), 0.02f) << x << " " << withShadows;
    }
  }
}

TEST(BumpFitter, RecoversRoughnessAndNormalsOfGlossyTexelsInShadow) {
  const MemoryBtf source(kNormals, 1, [&](int x, int, glm::vec3 v, glm::vec3 l) {
    return glm::vec3(isShadowed(x, l) ? 0.02f : valueOfSurface(glossySurface(x), v, l));
  });
  const FitResult fit = valueOf(fitReflectanceField(source, bumpOptions()));
  EXPECT_TRUE(fit.field.description().hasCosine);
  EXPECT_EQ(fit.field.layers().layers(), 0);
  for (int x = 0; x < kNormals; ++x) {
    const Surface found = surfaceAt(fit.field, x);
    const Surface truth = glossySurface(x);
    EXPECT_LT(degreesBetween(found.normal, truth.normal), 0.3) << x;
    EXPECT_NEAR(found.albedo, truth.albedo, 0.01f) << x;
    EXPECT_NEAR(found.roughness, truth.roughness, 0.02f) << x;
  }
}

TEST(BumpFitter, BlackConstantAndBrokenTexelsGiveFiniteNumbers) {
  const MemoryBtf source(3, 1, [](int x, int, glm::vec3, glm::vec3) {
    return glm::vec3(x == 0 ? 0.0f : x == 1 ? 0.5f : std::numeric_limits<float>::quiet_NaN());
  });
  // refuses what is not finite
  const FitResult fit = valueOf(fitReflectanceField(source, bumpOptions()));
  for (int x : {0, 2}) {
    EXPECT_EQ(surfaceAt(fit.field, x).albedo, 0.0f);
    EXPECT_EQ(surfaceAt(fit.field, x).normal, glm::vec3(0.0f, 0.0f, 1.0f));
    EXPECT_EQ(surfaceAt(fit.field, x).roughness, 1.0f);
  }
  EXPECT_NEAR(fit.field.evaluate(1, 0, directionFromDegrees(20, 20), {0, 0, 1}).y, 0.5f, 0.3f);
}

TEST(BumpFitter, LightsThatDoNotDetermineANormalAreRefused) {
  MemoryBtf source(1, 1, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(l.z); });
  const auto refusedWith = [&](const char* reason) {
    const auto fit = fitReflectanceField(source, bumpOptions());
    return !fit && fit.error().message().find(reason) != std::string::npos;
  };
  source.description().lights.resize(5);
  EXPECT_TRUE(refusedWith("5 lights"));
  source.description().lights.clear();
  for (int theta = -70; theta <= 70; theta += 10)
    source.description().lights.push_back(directionFromDegrees(theta, 30));
  EXPECT_TRUE(refusedWith("in one plane"));
}

TEST(BumpFitter, ColourChannelsHaveNoNormalsOfTheirOwn) {
  FitOptions options = bumpOptions();
  options.model.options["color"] = "rgb";
  const MemoryBtf source(1, 1, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(l.z); });
  EXPECT_FALSE(fitReflectanceField(source, options));
}

}  // namespace
}  // namespace weft
