#include "weft/fitter/DefaultModel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "weft/core/Direction.h"

namespace weft {
namespace {

// So many lights around one view, spread over the hemisphere.
BtfDescription dome(int lights) {
  BtfDescription measured;
  measured.views = {{0, 0, 1}};
  for (int i = 0; i < lights; ++i)
    measured.lights.push_back(directionFromDegrees(75.0 * std::sqrt((i + 0.5) / lights), 137.5 * i));
  return measured;
}

TEST(DefaultModel, OfOneViewFollowsFromTheNumberOfLights) {
  const std::pair<int, const char*> models[] = {{6, "ptm"},  {7, "ptm"},   {8, "rfp"},
                                                {15, "rfp"}, {16, "rfnl"}, {60, "rfnl"}};
  for (const auto& [lights, name] : models) {
    const DefaultModel model = defaultModel(dome(lights));
    EXPECT_EQ(model.name, name) << lights;
    EXPECT_EQ(model.reason, std::to_string(lights) + " lights of one view");
  }
}

TEST(DefaultModel, DoesNotCountLightsBelowTheHorizon) {
  BtfDescription measured = dome(15);
  measured.lights.push_back({0.6f, 0, -0.8f});
  EXPECT_EQ(defaultModel(measured).name, "rfp");
}

TEST(DefaultModel, OnARingOfLightsIsOneThatTheyDetermine) {
  BtfDescription ring;
  ring.views = {{0, 0, 1}};
  for (int i = 0; i < 12; ++i) ring.lights.push_back(directionFromDegrees(45, 30 * i));
  EXPECT_EQ(defaultModel(ring).name, "bump");
  EXPECT_EQ(defaultModel(ring).reason, "12 lights of one view, which do not determine rfp");
}

TEST(DefaultModel, OfTooFewLightsIsRefusedByItsFitter) {
  EXPECT_EQ(defaultModel(dome(4)).name, "ptm");
}

TEST(DefaultModel, OfSeveralViewsIsLoom) {
  BtfDescription measured = dome(6);
  measured.views.push_back({1, 0, 0});
  EXPECT_EQ(defaultModel(measured).name, "loom");
}

}  // namespace
}  // namespace weft
