#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "Epsilon.h"
#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"
#include "weft/fitter/LafSolver.h"

namespace weft {
namespace {

using test::epsilon;
using test::MemoryBtf;
using test::valueOf;

FitOptions lafOptions(const std::string& model, int lobes) {
  FitOptions options;
  options.model.name = model;
  options.model.options["lobes"] = lobes;
  return options;
}

// A broad retro-reflecting and a glossy lobe over a diffuse albedo of 0.1.
float twoLafLobes(glm::vec3 v, glm::vec3 l) {
  const glm::vec3 p = l * v;
  return 0.1f + 0.3f * std::pow(std::max(glm::dot(p, glm::vec3(0.6f, 0.5f, 1.0f)), 0.0f), 3.0f) +
         0.6f * std::pow(std::max(glm::dot(p, glm::vec3(-1.0f, -0.9f, 0.95f)), 0.0f), 14.0f);
}

// Views on the +x side show less, as behind a thread.
float viewFactor(glm::vec3 v) {
  return v.x > 0.3f ? 0.5f : 1.0f + 0.3f * v.y;
}

TEST(LafFit, RecoversItsLobes) {
  const glm::vec3 color(0.5f, 0.9f, 0.2f);
  const MemoryBtf source(1, 1,
                         [&](int, int, glm::vec3 v, glm::vec3 l) { return color * l.z * twoLafLobes(v, l); });
  const FitResult fit = valueOf(fitReflectanceField(source, lafOptions("laf", 2)));
  EXPECT_NEAR(fit.field.shared().at(0, 0, 3), 0.1f * luminance(color), 0.003f);
  EXPECT_LT(epsilon(fit), 1e-3);
  EXPECT_LT(fit.errors.of(ErrorSpace::Linear, ErrorMeasure::Rgb).average, 1e-3);
}

TEST(LafFit, SlafRecoversTheViewFactors) {
  const MemoryBtf source(1, 1, [](int, int, glm::vec3 v, glm::vec3 l) {
    return glm::vec3(l.z * viewFactor(v) * twoLafLobes(v, l));
  });
  const FitResult fit = valueOf(fitReflectanceField(source, lafOptions("slaf", 2)));
  EXPECT_LT(epsilon(fit), 1e-3);
  double mean = 0.0;
  for (const glm::vec3 view : source.description().views) mean += viewFactor(view) / 81.0;
  double meanFactor = 0.0;
  for (int view = 0; view < 81; ++view) {
    const float factor = fit.field.layers().at(0, 0, 0, view);
    meanFactor += factor / 81.0;
    EXPECT_NEAR(factor, viewFactor(source.description().views[static_cast<std::size_t>(view)]) / mean, 0.02)
        << view;
  }
  EXPECT_NEAR(meanFactor, 1.0, 1e-3);
  EXPECT_GT(epsilon(valueOf(fitReflectanceField(source, lafOptions("laf", 2)))), 10.0 * epsilon(fit));
}

TEST(LafFit, EachColorChannelMayHaveLobesOfItsOwn) {
  const MemoryBtf source(1, 1, [](int, int, glm::vec3 v, glm::vec3 l) {
    return l.z * glm::vec3(twoLafLobes(v, l), 0.2f, 0.1f + 0.2f * l.z * v.z);
  });
  for (const char* model : {"laf", "slaf"}) {
    FitOptions options = lafOptions(model, 2);
    options.model.options["color"] = "rgb";
    EXPECT_LT(valueOf(fitReflectanceField(source, options))
                  .errors.of(ErrorSpace::Linear, ErrorMeasure::Rgb)
                  .average,
              2e-3)
        << model;
  }
}

// conventions.md, "Cosine".
TEST(LafFit, WhiteLambertianIsTheCosine) {
  for (const char* model : {"laf", "slaf"})
    for (const bool cosineInData : {true, false}) {
      const MemoryBtf source(
          1, 1, [&](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(cosineInData ? l.z : 1.0f); },
          cosineInData);
      const FitResult fit = valueOf(fitReflectanceField(source, lafOptions(model, 4)));
      for (int theta = 0; theta <= 90; theta += 3)
        for (int phi = 0; phi < 360; phi += 45) {
          const glm::vec3 light = directionFromDegrees(theta, phi);
          for (const double viewTheta : {0.0, 35.0, 75.0, 89.0})
            EXPECT_NEAR(fit.field.evaluate(0, 0, light, directionFromDegrees(viewTheta, 77)).y,
                        std::max(light.z, 0.0f), 1e-3)
                << model << (cosineInData ? " with" : " without") << " n.l, theta " << theta;
        }
    }
}

TEST(LafFit, TheCosineMayStayInTheModel) {
  const MemoryBtf source(
      1, 1, [](int, int, glm::vec3 v, glm::vec3 l) { return glm::vec3(l.z * twoLafLobes(v, l)); });
  for (const char* model : {"laf", "slaf"}) {
    FitOptions options = lafOptions(model, 4);
    options.cosineInModel = true;
    const FitResult fit = valueOf(fitReflectanceField(source, options));
    EXPECT_LT(epsilon(fit), 0.02);
    for (int phi = 0; phi < 360; phi += 15)
      EXPECT_LT(fit.field.evaluate(0, 0, directionFromDegrees(89.9, phi), directionFromDegrees(40, 20)).y,
                1.0f / 255.0f);
  }
}

TEST(LafFit, BlackAndBrokenTexelsGiveFiniteNumbers) {
  const MemoryBtf source(4, 1, [](int x, int, glm::vec3 v, glm::vec3 l) {
    if (x == 0) return glm::vec3(0.0f);
    if (x == 1) return glm::vec3(std::numeric_limits<float>::quiet_NaN());
    if (x == 2) return glm::vec3(l.x > 0.9f ? std::numeric_limits<float>::infinity() : 0.5f);
    return glm::vec3(v.x > 0.9f ? 0.0f : 0.5f * l.z);  // black in a few views alone
  });
  for (const char* model : {"laf", "slaf"}) {
    const FitResult fit =
        valueOf(fitReflectanceField(source, lafOptions(model, 4)));  // refuses what is not finite
    EXPECT_LT(glm::length(fit.field.evaluateLayer(0, 0, 3, directionFromDegrees(20, 20), {0, 0, 1})), 1e-3f);
    EXPECT_TRUE(std::isfinite(epsilon(fit)));
    EXPECT_GT(fit.field.evaluateLayer(3, 0, 0, directionFromDegrees(20, 20), {0, 0, 1}).y, 0.05f) << model;
  }
}

TEST(LafFit, FewerSamplesThanNumbersAreRefused) {
  MemoryBtf source(1, 1, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(l.z); });
  source.description().lights.resize(4);
  source.description().views.resize(4);
  const auto fit = fitReflectanceField(source, lafOptions("laf", 4));
  ASSERT_FALSE(fit);
  EXPECT_NE(fit.error().message().find("16 samples"), std::string::npos) << fit.error().message();
  EXPECT_TRUE(fitReflectanceField(source, lafOptions("laf", 3)));
  EXPECT_FALSE(fitReflectanceField(source, lafOptions("slaf", 3)));
}

TEST(LafFit, OneViewIsEnough) {
  const glm::vec3 view = directionFromDegrees(50, 0);
  MemoryBtf source(1, 1,
                   [](int, int, glm::vec3 v, glm::vec3 l) { return glm::vec3(l.z * twoLafLobes(v, l)); });
  source.description().views = {view};
  for (const char* model : {"laf", "slaf"}) {
    const FitResult fit = valueOf(fitReflectanceField(source, lafOptions(model, 2)));
    EXPECT_LT(epsilon(fit), 3e-3) << model;
    EXPECT_NEAR(fit.field.evaluate(0, 0, directionFromDegrees(52, 170), view).x,
                directionFromDegrees(52, 170).z * twoLafLobes(view, directionFromDegrees(52, 170)), 0.02);
  }
}

// [Meseth 2004] 5.3: the largest value over what a view's brightest sample is.
double whitestPixel(const ReflectanceField& field, int x, std::span<const glm::vec3> samples) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const std::vector<glm::vec3>& views = field.description().views;
  const std::size_t lights = samples.size() / views.size();
  double whitest = 0.0;
  for (std::size_t view = 0; view < views.size(); ++view) {
    float brightest = 0.0f;
    for (const glm::vec3 rgb : samples.subspan(view * lights, lights))
      brightest = std::max(brightest, luminance(rgb));
    for (int k = 0; k < 100; ++k) {
      const float z = unit(random);
      const float phi = 6.2831853f * unit(random);
      const glm::vec3 light(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
      const glm::vec3 value = field.evaluateLayer(x, 0, static_cast<int>(view), light, views[view]);
      whitest = std::max(whitest, double{luminance(value) / brightest});
    }
  }
  return whitest;
}

// The order of table 1 of M, bounds a few percent above what is known of this row, and no white
// pixels.
TEST(LafFit, SlafLiesBetweenRfnlAndLafOnRealMaterials) {
  struct Known {
    const char* file;
    double laf, slaf;
  };
  for (const Known& known :
       {Known{"ubo2003/UBO_WOOL64.zip", 0.073, 0.053}, Known{"ubo2003/UBO_CORDUROY64.zip", 0.132, 0.090}}) {
    WEFT_DATA_FILE(file, known.file);
    const auto source = valueOf(openBtf(file));
    const auto fitOf = [&](const char* model, int lobes) {
      FitOptions options = lafOptions(model, lobes);
      options.crop = Crop{0, 28, 64, 1};
      return valueOf(fitReflectanceField(*source, options));
    };
    const double rfnl = epsilon(fitOf("rfnl", 2), ErrorSpace::Stored);
    const FitResult slaf = fitOf("slaf", 4);
    const FitResult laf = fitOf("laf", 4);
    EXPECT_LT(rfnl, epsilon(slaf, ErrorSpace::Stored)) << known.file;
    EXPECT_LT(epsilon(slaf, ErrorSpace::Stored), known.slaf) << known.file;
    EXPECT_LT(known.slaf, epsilon(laf, ErrorSpace::Stored)) << known.file;
    EXPECT_LT(epsilon(laf, ErrorSpace::Stored), known.laf) << known.file;

    SampleRows rows;
    ASSERT_TRUE(source->readRows(28, 1, rows));
    std::vector<glm::vec3> samples(rows.pairs());
    for (int x = 0; x < 64; ++x) {
      rows.linear(0, x, samples);
      EXPECT_LT(whitestPixel(slaf.field, x, samples), 1.5) << known.file << ", slaf, texel " << x;
      EXPECT_LT(whitestPixel(laf.field, x, samples), 1.5) << known.file << ", laf, texel " << x;
    }
  }
}

}  // namespace
}  // namespace weft
