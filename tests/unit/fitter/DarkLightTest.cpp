// Lights on and below the horizon: whatever their images show, fits and errors are those without
// them.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

MemoryBtf glossyBall() {
  return MemoryBtf(2, 1, [](int x, int, glm::vec3 view, glm::vec3 light) {
    if (light.z <= 0.0f) return glm::vec3(1.0f);  // a photograph of something else
    const float shine = std::pow(std::max(glm::dot(light, glm::vec3(-view.x, -view.y, view.z)), 0.0f), 9.0f);
    return light.z * glm::vec3(0.3f + 0.1f * static_cast<float>(x), 0.3f, 0.2f + 0.4f * shine);
  });
}

void addDarkLights(BtfDescription& measured) {
  measured.lights.insert(measured.lights.begin() + 5, glm::normalize(glm::vec3(0.2f, 0.9f, -0.3f)));
  measured.lights.push_back(directionFromDegrees(90.07, 15));
  measured.lights.push_back({1, 0, 0});
}

void expectSameFits(const FitOptions& options, bool oneView) {
  MemoryBtf lit = glossyBall();
  if (oneView) lit.description().views = {glm::vec3(0, 0, 1)};
  MemoryBtf dark = glossyBall();
  dark.description().views = lit.description().views;
  addDarkLights(dark.description());
  const FitResult expected = valueOf(fitReflectanceField(lit, options));
  const FitResult fit = valueOf(fitReflectanceField(dark, options));
  const std::string& model = options.model.name;
  EXPECT_EQ(fit.field.description().lights, expected.field.description().lights) << model;
  EXPECT_TRUE(std::ranges::equal(fit.field.shared().values(), expected.field.shared().values())) << model;
  EXPECT_TRUE(std::ranges::equal(fit.field.layers().values(), expected.field.layers().values())) << model;
  // but for the order of sums
  for (const ErrorSpace space : {ErrorSpace::Stored, ErrorSpace::Linear})
    EXPECT_NEAR(fit.errors.of(space, ErrorMeasure::Rgb).average,
                expected.errors.of(space, ErrorMeasure::Rgb).average, 1e-7)
        << model;
}

TEST(DarkLight, HasNoWeightInAnyModelWithAnyCosine) {
  for (const std::string model : {"rfp", "rfnl", "laf", "lfp", "bump"})
    for (const bool cosineInModel : {false, true}) {
      FitOptions options;
      options.model.name = model;
      options.cosineInModel = cosineInModel;
      expectSameFits(options, false);
    }
}

TEST(DarkLight, HasNoWeightInOneViewAndStoredSpace) {
  FitOptions options;
  options.model.name = "ptm";
  options.space = FitSpace::Stored;
  expectSameFits(options, true);
}

TEST(DarkLight, IsNotHeldOut) {
  FitOptions options;
  options.model.name = "rfp";
  MemoryBtf dark = glossyBall();
  addDarkLights(dark.description());
  EXPECT_FALSE(valueOf(fitReflectanceField(dark, options)).heldOut);
  options.holdOutLights = 8;
  const FitResult fit = valueOf(fitReflectanceField(dark, options));
  ASSERT_TRUE(fit.heldOut);
  for (const glm::vec3 light : fit.field.description().lights) EXPECT_GT(light.z, 0.0f);
}

}  // namespace
}  // namespace weft
