#include "weft/reflectance/ReflectanceField.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {
namespace {

using test::valueOf;

struct Parts {
  std::shared_ptr<const ReflectanceModel> model = valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  ReflectanceFieldDescription description;
  FloatImage shared{2, 1, model->sharedChannels()};
  FloatImage views{2, 1, model->layerChannels(), 3};

  Parts() {
    description.views = {{0, 0, 1}, directionFromDegrees(60, 0), directionFromDegrees(60, 120)};
    description.lights = {{0, 0, 1}, directionFromDegrees(75, 0)};
    for (float& value : shared.values()) value = 1.0f;
    for (int view = 0; view < 3; ++view)
      for (int x = 0; x < 2; ++x) views.at(x, 0, 5, view) = static_cast<float>(view + 1);
  }

  Result<ReflectanceField> make() const {
    return ReflectanceField::create(model, description, shared, views);
  }
};

TEST(ReflectanceField, IsTheModelTimesTheCosine) {
  const ReflectanceField field = valueOf(Parts().make());
  for (double theta : {0.0, 30.0, 75.0, 85.0, 89.9}) {
    const glm::vec3 light = directionFromDegrees(theta, 40);
    EXPECT_NEAR(field.evaluateLayer(0, 0, 1, light, {0, 0, 1}).x, 2.0f * light.z, 1e-6);
  }
  EXPECT_EQ(field.evaluateLayer(0, 0, 1, directionFromDegrees(90.1, 0), {0, 0, 1}).x, 0.0f);
}

TEST(ReflectanceField, WithTheCosineInsideFadesBelowTheLowestMeasuredLight) {
  Parts parts;
  parts.description.hasCosine = true;
  for (int x = 0; x < 2; ++x) parts.views.at(x, 0, 3, 0) = 1.0f;  // 1 + l.x: tells where it is evaluated
  const ReflectanceField field = valueOf(parts.make());
  const glm::vec3 ring = directionFromDegrees(75, 30);
  EXPECT_NEAR(field.evaluateLayer(0, 0, 0, ring, {0, 0, 1}).x, 1.0f + ring.x, 1e-5);
  const glm::vec3 below = directionFromDegrees(85, 30);
  EXPECT_NEAR(field.evaluateLayer(0, 0, 0, below, {0, 0, 1}).x, (1.0f + ring.x) * below.z / ring.z, 1e-5);
  EXPECT_EQ(field.evaluateLayer(0, 0, 0, directionFromDegrees(95, 30), {0, 0, 1}).x, 0.0f);
}

TEST(ReflectanceField, WithTheCosineInsideAndLightFromTheNormalAloneIsFiniteEverywhere) {
  Parts parts;
  parts.description.hasCosine = true;
  parts.description.lights = {{0, 0, 1.0005f}};  // as long as rounding may make it
  const ReflectanceField field = valueOf(parts.make());
  EXPECT_NEAR(field.evaluateLayer(0, 0, 0, {0, 0, 0.9999999f}, {0, 0, 1}).x, 1.0f, 1e-5);
  EXPECT_NEAR(field.evaluateLayer(0, 0, 0, directionFromDegrees(60, 30), {0, 0, 1}).x, 0.5f, 1e-5);
}

TEST(ReflectanceField, InterpolatesViewsWithTheirWeights) {
  const ReflectanceField field = valueOf(Parts().make());
  const DirectionWeights weights{{0, 1, 2}, {0.5f, 0.25f, 0.25f}};
  EXPECT_NEAR(field.evaluate(1, 0, weights, {0, 0, 1}, {0, 0, 1}).x, 0.5f * 1 + 0.25f * 2 + 0.25f * 3, 1e-6);
}

TEST(ReflectanceField, RefusesPartsThatDoNotFit) {
  Parts parts;
  parts.views.at(0, 0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(parts.make());

  parts = Parts();
  parts.views = FloatImage(1, 1, parts.model->layerChannels(), 3);
  EXPECT_FALSE(parts.make());

  parts = Parts();
  parts.shared = FloatImage(2, 1, {"R", "G", "wrong"});
  EXPECT_FALSE(parts.make());

  parts = Parts();
  parts.description.views.pop_back();
  EXPECT_FALSE(parts.make());

  parts = Parts();
  parts.description.views[1] = parts.description.views[0];
  EXPECT_FALSE(parts.make());

  parts = Parts();
  parts.description.lights.clear();
  EXPECT_FALSE(parts.make());

  parts = Parts();
  parts.description.lights[0] *= 2.0f;
  EXPECT_FALSE(parts.make());
}

}  // namespace
}  // namespace weft
