#include "weft/reflectance/LafModel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/core/FloatImage.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {
namespace {

using test::valueOf;

// Lafortune's own form, (C . P)^n, has the amplitude inside.
TEST(LafModel, IsLafortunesFormula) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "laf", .options = {{"lobes", 2}}}));
  EXPECT_EQ(model->layerDirections(), LayerDirections::None);
  const glm::vec3 mirror(-1.1f, -0.9f, 1.05f);
  const glm::vec3 grazing(0.3f, 0.8f, -0.5f);
  const auto packed = [](glm::vec3 axes, float exponent) {
    const float largest = std::max({std::abs(axes.x), std::abs(axes.y), axes.z});
    const glm::vec2 p = packedLafAxes(axes / largest);
    return std::array{std::pow(largest, exponent), p.x, p.y, exponent};
  };
  const auto first = packed(mirror, 9.0f);
  const auto second = packed(grazing, 2.0f);
  std::vector<float> shared{0.125f};
  shared.insert(shared.end(), first.begin(), first.end());
  shared.insert(shared.end(), second.begin(), second.end());
  for (double phi = 0.0; phi < 360.0; phi += 15.0) {
    const glm::vec3 l = directionFromDegrees(55, phi);
    const glm::vec3 v = directionFromDegrees(70, 40);
    const float expected = 0.125f + std::pow(std::max(glm::dot(mirror, l * v), 0.0f), 9.0f) +
                           std::pow(std::max(glm::dot(grazing, l * v), 0.0f), 2.0f);
    EXPECT_NEAR(model->evaluate(shared, {}, l, v), expected, 1e-5);
    EXPECT_EQ(model->evaluate(shared, {}, l, v), model->evaluate(shared, {}, v, l)) << "reciprocity";
  }
}

TEST(LafModel, SlafIsThatTimesTheViewFactor) {
  const auto laf = valueOf(ModelRegistry::builtin().create({.name = "laf", .options = {{"lobes", 1}}}));
  const auto slaf = valueOf(ModelRegistry::builtin().create({.name = "slaf", .options = {{"lobes", 1}}}));
  EXPECT_EQ(slaf->layerDirections(), LayerDirections::Views);
  const std::array shared{0.1f, 0.5f, -1.0f, -0.75f, 3.0f};
  const std::array factor{0.25f};
  const glm::vec3 l = directionFromDegrees(30, 200);
  const glm::vec3 v = directionFromDegrees(45, 20);
  EXPECT_NEAR(slaf->evaluate(shared, factor, l, v), 0.25f * laf->evaluate(shared, {}, l, v), 1e-7);
}

TEST(LafModel, PackedAxesComeBackAndAnyTwoNumbersAreAxes) {
  for (const glm::vec3 axes : {glm::vec3(0, 0, 1), glm::vec3(-1, -1, 1), glm::vec3(0.3f, -0.4f, 1),
                               glm::vec3(1, 0.2f, 0.5f), glm::vec3(-0.1f, -1, -1), glm::vec3(1, 1, -8)})
    EXPECT_LT(glm::distance(lafAxes(packedLafAxes(axes)), axes), 1e-5f);
  for (float p = -9.0f; p <= 9.0f; p += 0.37f)
    for (float q = -9.0f; q <= 9.0f; q += 0.37f) {
      const glm::vec3 axes = lafAxes({p, q});
      EXPECT_NEAR(std::max({std::abs(axes.x), std::abs(axes.y), axes.z}), 1.0f, 1e-6);
    }
}

TEST(LafModel, OneToTenLobes) {
  const ModelRegistry registry = ModelRegistry::builtin();
  for (const char* name : {"laf", "slaf"}) {
    EXPECT_EQ(valueOf(registry.create({.name = name, .options = {{"lobes", 10}}}))->sharedParameters().size(),
              41u);
    EXPECT_FALSE(registry.create({.name = name, .options = {{"lobes", 0}}}));
    EXPECT_FALSE(registry.create({.name = name, .options = {{"lobes", 11}}}));
  }
}

// Nothing holds a formula of the view where no view was measured.
TEST(LafModel, IsSeenFromNoLowerViewThanMeasured) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "laf", .options = {{"lobes", 1}}}));
  ReflectanceFieldDescription description;
  description.views = {{0, 0, 1}, directionFromDegrees(60, 0), directionFromDegrees(60, 120)};
  description.lights = {{0, 0, 1}};
  FloatImage shared(1, 1, model->sharedChannels());
  const std::array numbers{1.0f, 1.0f, 1.0f, 0.1f, 1.0f, 1.0f, 0.5f, 4.0f};
  std::ranges::copy(numbers, shared.values().begin());
  const ReflectanceField field = valueOf(ReflectanceField::create(model, description, std::move(shared), {}));
  const glm::vec3 light = directionFromDegrees(50, 15);
  const float onRing = field.evaluate(0, 0, light, directionFromDegrees(60, 70)).x;
  EXPECT_NE(field.evaluate(0, 0, light, directionFromDegrees(55, 70)).x, onRing);
  for (const double theta : {61.0, 75.0, 90.0, 100.0})
    EXPECT_NEAR(field.evaluate(0, 0, light, directionFromDegrees(theta, 70)).x, onRing, 1e-6);
}

}  // namespace
}  // namespace weft
