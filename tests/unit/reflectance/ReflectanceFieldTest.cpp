#include "weft/reflectance/ReflectanceField.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "RampModel.h"
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
  // 1 + l.x: tells where it is evaluated
  for (int x = 0; x < 2; ++x) parts.views.at(x, 0, 3, 0) = 1.0f;
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

// What a field of these levels is refused with.
std::string refusalOf(const Parts& parts, std::vector<FieldLevel> levels) {
  const auto field = ReflectanceField::create(parts.model, parts.description, std::move(levels));
  return field ? "made" : field.error().message();
}

TEST(ReflectanceField, HasLevelsThatHalve) {
  const Parts parts;
  const auto level = [&](int width, int height) {
    return FieldLevel{FloatImage(width, height, parts.model->sharedChannels()),
                      FloatImage(width, height, parts.model->layerChannels(), 3)};
  };
  EXPECT_EQ(refusalOf(parts, {level(5, 2), level(2, 1), level(1, 1)}), "made");
  EXPECT_EQ(refusalOf(parts, {}), "a field has at least one level");
  EXPECT_EQ(refusalOf(parts, {level(5, 2), level(3, 1)}),
            "level 1 of a field of 5 x 2 texels has 3 x 1 instead of 2 x 1");
  EXPECT_EQ(refusalOf(parts, {level(1, 1), level(1, 1)}), "level 1 of a field follows one of a single texel");
  FieldLevel fewer = level(2, 1);
  fewer.layers = FloatImage(2, 1, parts.model->layerChannels(), 2);
  EXPECT_EQ(refusalOf(parts, {level(5, 2), fewer}), "3 layers are described and 2 are there");
}

struct RampParts {
  std::shared_ptr<const ReflectanceModel> model =
      valueOf(test::RampModel::registry().create({"ramp", {{"power", 0}}}));
  ReflectanceFieldDescription description;
  FloatImage ramp{3, 1, {"value"}};

  RampParts() {
    description.views = description.lights = {{0, 0, 1}};
    std::ranges::copy(std::array{0.1f, 0.5f, 0.7f}, ramp.values().begin());
  }

  Result<ReflectanceField> make(const FieldTables& tables) const {
    FieldLevel level{FloatImage(1, 1, {"R", "G", "B"}), FloatImage(1, 1, {"place"}, 1)};
    std::ranges::fill(level.shared.values(), 1.0f);
    level.layers.at(0, 0, 0) = 0.75f;
    return ReflectanceField::create(model, description, {level}, tables);
  }

  std::string refusalOf(const FieldTables& tables) const {
    const auto field = make(tables);
    return field ? "made" : field.error().message();
  }
};

TEST(ReflectanceField, EvaluatesWithItsTables) {
  const RampParts parts;
  const ReflectanceField field = valueOf(parts.make({{"ramp", parts.ramp}}));
  EXPECT_NEAR(field.evaluate(0, 0, {0, 0, 1}, {0, 0, 1}).x, 0.6f, 1e-6);
  EXPECT_EQ(field.tables().at("ramp").width(), 3);
}

TEST(ReflectanceField, RefusesTablesThatAreNotTheModels) {
  const RampParts parts;
  EXPECT_EQ(parts.refusalOf({}), "the table 'ramp' of the model 'ramp' is missing");
  EXPECT_EQ(parts.refusalOf({{"ramp", parts.ramp}, {"stairs", parts.ramp}}),
            "the model 'ramp' has no table 'stairs'");
  EXPECT_EQ(parts.refusalOf({{"ramp", FloatImage(3, 1, {"height"})}}),
            "the channels of the table 'ramp' are not those of the model");
  EXPECT_EQ(parts.refusalOf({{"ramp", FloatImage(3, 2, {"value"})}}),
            "the table 'ramp' has 3 x 2 texels in 1 layers, the model needs any x 1 in one");
  EXPECT_EQ(parts.refusalOf({{"ramp", FloatImage(1, 1, {"value"})}}), "a ramp has two ends");
  FloatImage infinite = parts.ramp;
  infinite.at(1, 0, 0) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(parts.refusalOf({{"ramp", infinite}}), "a number of the table 'ramp' is not finite");
}

TEST(ReflectanceField, ANumberTooFewEndsTheProgramWithAMessage) {
  const ReflectanceField field = valueOf(Parts().make());
  const std::array<float, 3> shared{};
  const std::array<float, 5> five{};
  EXPECT_DEATH(field.formula().evaluate(shared, five, {0, 0, 1}, {0, 0, 1}), "as many numbers as its model");
  std::array<glm::vec3, 1> values;
  const std::array<glm::vec3, 2> lights{glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)};
  EXPECT_DEATH(field.model().evaluateColors(shared, field.layers().texel(0, 0), lights, {0, 0, 1}, values),
               "room for a colour a light");
}

}  // namespace
}  // namespace weft
