#include "weft/reflectance/ModelRegistry.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "TestSupport.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

using test::valueOf;

const glm::vec3 kView(0.6f, 0.0f, 0.8f);  // where it does not matter

TEST(ReflectanceModel, RfpIsThePaperPolynomialTimesTheBaseColor) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  const std::array shared{0.5f, 1.0f, 2.0f};
  const std::array a{0.1f, -0.2f, 0.3f, 0.4f, -0.5f, 0.9f};
  const glm::vec3 l = directionFromDegrees(40, 70);
  const float expected =
      0.1f * l.x * l.x - 0.2f * l.y * l.y + 0.3f * l.x * l.y + 0.4f * l.x - 0.5f * l.y + 0.9f;
  const glm::vec3 value = model->evaluateColor(shared, a, l, kView);
  EXPECT_NEAR(value.x, 0.5f * expected, 1e-6);
  EXPECT_NEAR(value.y, expected, 1e-6);
  EXPECT_NEAR(value.z, 2.0f * expected, 1e-6);
}

TEST(ReflectanceModel, NegativeValuesBecomeBlack) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfp"}));
  const std::array shared{1.0f, 1.0f, 1.0f};
  const std::array a{0.0f, 0.0f, 0.0f, 0.0f, 0.0f, -1.0f};
  EXPECT_EQ(model->evaluateColor(shared, a, {0, 0, 1}, kView), glm::vec3(0.0f));
}

TEST(ReflectanceModel, RfnlLobesAreCosinePowersAroundTheirDirections) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfnl", .options = {{"lobes", 2}}}));
  const glm::vec3 first = directionFromDegrees(30, 20);
  const glm::vec3 second = directionFromDegrees(60, 200);
  const glm::vec2 p = parabolicFromDirection(first);
  const glm::vec2 q = parabolicFromDirection(second);
  const std::array shared{1.0f, 0.5f, 0.25f, 0.125f};
  const std::array view{0.7f, p.x, p.y, 12.0f, 0.4f, q.x, q.y, 3.0f};
  for (double phi = 0.0; phi < 360.0; phi += 30.0) {
    const glm::vec3 l = directionFromDegrees(50, phi);
    const float expected = 0.125f + 0.7f * std::pow(std::max(glm::dot(first, l), 0.0f), 12.0f) +
                           0.4f * std::pow(std::max(glm::dot(second, l), 0.0f), 3.0f);
    const glm::vec3 value = model->evaluateColor(shared, view, l, kView);
    EXPECT_NEAR(value.x, expected, 1e-5);
    EXPECT_NEAR(value.y, 0.5f * expected, 1e-5);
    EXPECT_NEAR(value.z, 0.25f * expected, 1e-5);
  }
}

TEST(ReflectanceModel, RfnlMayHaveADiffuseAlbedoOfEachViewsOwn) {
  const auto model = valueOf(
      ModelRegistry::builtin().create({.name = "rfnl", .options = {{"lobes", 1}, {"rho_d", "per-view"}}}));
  EXPECT_EQ(model->sharedChannels().size(), 3u);
  ASSERT_EQ(model->layerChannels().back(), "rho_d");
  const std::array shared{1.0f, 1.0f, 1.0f};
  const std::array view{0.0f, 0.0f, 0.0f, 1.0f, 0.3f};
  EXPECT_NEAR(model->evaluateColor(shared, view, {0, 0, 1}, kView).x, 0.3f, 1e-6);
}

TEST(ReflectanceModel, LightFieldsHaveLightAndViewExchanged) {
  const glm::vec3 light = directionFromDegrees(40, 70);
  const glm::vec3 view = directionFromDegrees(20, 200);
  const std::array polynomial{0.1f, -0.2f, 0.3f, 0.4f, -0.5f, 0.9f};
  const std::array lobe{0.7f, 0.1f, 0.2f, 12.0f};
  const std::array diffuse{0.1f};
  const ModelRegistry registry = ModelRegistry::builtin();
  const auto model = [&](const char* name) { return valueOf(registry.create({.name = name})); };
  const auto lobed = [&](const char* name) {
    return valueOf(registry.create({.name = name, .options = {{"lobes", 1}}}));
  };
  EXPECT_EQ(model("lfp")->layerDirections(), LayerDirections::Lights);
  EXPECT_EQ(model("lfp")->evaluate({}, polynomial, light, view),
            model("rfp")->evaluate({}, polynomial, view, light));
  EXPECT_EQ(lobed("lfnl")->evaluate(diffuse, lobe, light, view),
            lobed("rfnl")->evaluate(diffuse, lobe, view, light));
}

TEST(ReflectanceModel, EachColorChannelMayHaveNumbersOfItsOwn) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfp", .options = {{"color", "rgb"}}}));
  const std::vector<std::string> channels = model->layerChannels();
  ASSERT_EQ(channels.size(), 18u);
  EXPECT_EQ(channels[0], "a0.R");
  EXPECT_EQ(channels[17], "a5.B");
  std::array<float, 18> numbers{};
  numbers[5] = 0.25f;
  numbers[11] = 0.5f;
  numbers[17] = 0.75f;
  const std::array shared{2.0f, 1.0f, 1.0f};
  EXPECT_EQ(model->evaluateColor(shared, numbers, kView, kView), glm::vec3(0.5f, 0.5f, 0.75f));
}

// At the mirror direction of a normal n, seen from 30 degrees off it: n.l (0.96 albedo + F pi D V)
// with the D and V of glTF's appendix B, where n.h is 1.
TEST(ReflectanceModel, BumpIsAGlossyDielectricAroundItsOwnNormal) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "bump"}));
  EXPECT_EQ(model->layerDirections(), LayerDirections::None);
  EXPECT_TRUE(model->containsCosine());
  const glm::vec3 n = directionFromDegrees(20, 90);
  const glm::vec2 p = parabolicFromDirection(n);
  const std::array numbers{0.4f, p.x, p.y, 0.5f};
  const double alpha = 0.25;
  const double cosine = std::cos(30.0 * M_PI / 180.0);
  const double d = 1.0 / (M_PI * alpha * alpha);
  const double v = 0.25 / (cosine * std::sqrt(cosine * cosine * (1.0 - alpha * alpha) + alpha * alpha));
  const double fresnel = 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0);
  EXPECT_NEAR(model->evaluate(numbers, {}, directionFromDegrees(50, 90), directionFromDegrees(10, 270)),
              cosine * ((1.0 - fresnel) * 0.4 + fresnel * M_PI * d * v), 1e-5);
  EXPECT_EQ(model->evaluate(numbers, {}, directionFromDegrees(85, 270), directionFromDegrees(10, 270)), 0.0f);
}

TEST(ReflectanceModel, UnknownModelsAndImpossibleLobesAreRefused) {
  const ModelRegistry registry = ModelRegistry::builtin();
  const auto unknown = registry.create({.name = "magic"});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message().find("magic"), std::string::npos);
  EXPECT_NE(unknown.error().hint.find("rfnl"), std::string::npos);
  EXPECT_FALSE(registry.create({.name = "rfnl", .options = {{"lobes", 0}}}));
  EXPECT_FALSE(registry.create({.name = "rfnl", .options = {{"lobes", 5}}}));
}

}  // namespace
}  // namespace weft
