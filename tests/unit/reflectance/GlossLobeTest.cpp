#include "weft/reflectance/GlossLobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {
namespace {

const glm::vec3 kViews[] = {directionFromDegrees(0, 0), directionFromDegrees(30, 200),
                            directionFromDegrees(60, 70)};

// The share of light from one direction that goes anywhere, as the lobe is reciprocal.
double reflectedShare(const GlossLobe& lobe, glm::vec3 view) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      // of equal projected area
      const double sine = std::sqrt((i + 0.5) / kSteps), phi = glm::two_pi<double>() * (j + 0.5) / kSteps;
      const glm::vec3 light(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1.0 - sine * sine));
      sum += double{lobe.evaluate(light, view)};
    }
  return sum / (kSteps * kSteps);
}

TEST(GlossLobe, ReflectsAboutItsAmountAndNeverMore) {
  for (const float alpha : {0.15f, 0.3f, 0.5f})
    for (const glm::vec3 view : kViews) {
      const double share = reflectedShare({{0.0f, 0.0f}, alpha, 0.5f}, view);
      EXPECT_LE(share, 0.5001);
      EXPECT_GT(share, 0.65 * 0.5) << alpha;
      // Head-on, microfacets that lean by more than 45 degrees send light downwards: of GGX all but
      // 1 / (1 + alpha^2) do not. The rest is theirs that stand in others' shadow.
      if (view.z < 1.0f) continue;
      const double most = 0.5 / (1.0 + double{alpha} * double{alpha});
      EXPECT_LE(share, 1.001 * most);
      EXPECT_GT(share, 0.85 * most);
    }
  EXPECT_NEAR(reflectedShare({{0.1f, 0.05f}, 0.2f, 0.5f}, kViews[0]), 0.5, 0.05);
}

// The formula of glTF, which is checked against other renderers, is the same but for Fresnel's.
TEST(GlossLobe, IsTheLobeOfBumpWithoutFresnelsFactorOnALevelSurface) {
  const auto bump = test::valueOf(ModelRegistry::builtin().create({.name = "bump"}));
  for (const float roughness : {0.4f, 0.7f})
    for (const glm::vec3 view : kViews)
      for (const glm::vec3 light : {directionFromDegrees(10, 20), directionFromDegrees(60, 250)}) {
        const float numbers[] = {0.0f, 0.0f, 0.0f, roughness};
        const float away = 1.0f - glm::dot(view, glm::normalize(view + light));
        const float fresnel = 0.04f + 0.96f * std::pow(away, 5.0f);
        const GlossLobe lobe{{0.0f, 0.0f}, roughness * roughness, fresnel};
        const float expected = bump->evaluate(numbers, {}, light, view);
        EXPECT_NEAR(lobe.evaluate(light, view) * light.z, expected, 1e-5f + 1e-4f * expected);
      }
}

TEST(GlossLobe, IsReciprocalAndKeepsItsNumbers) {
  const GlossLobe lobe{{0.2f, -0.3f}, 0.25f, 0.09f};
  EXPECT_NEAR(lobe.evaluate(kViews[1], kViews[2]), lobe.evaluate(kViews[2], kViews[1]), 1e-6f);
  const GlossLobe again = GlossLobe::from(lobe.numbers());
  EXPECT_NEAR(again.tilt.y, lobe.tilt.y, 1e-6f);
  EXPECT_NEAR(again.alpha, lobe.alpha, 1e-6f);
  EXPECT_NEAR(again.amount, lobe.amount, 1e-6f);
  const GlossLobe rounded = lobe.rounded();
  EXPECT_EQ(rounded.numbers(), rounded.rounded().numbers());
  EXPECT_NEAR(rounded.amount, lobe.amount, 0.003f);
}

}  // namespace
}  // namespace weft
