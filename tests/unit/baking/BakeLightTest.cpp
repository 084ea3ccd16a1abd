// How much light a baked BTF holds: its own BRDF, interreflections, energy, and the same on every
// run.

#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "BakedSource.h"
#include "TestSupport.h"
#include "weft/baking/BtfBaker.h"
#include "weft/baking/Pattern.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

/// GGX in double precision, written with slopes (tangents) and Smith's Lambda instead of the
/// baker's form.
double specularBrdf(double alpha, glm::dvec3 v, glm::dvec3 l) {
  const glm::dvec3 h = glm::normalize(v + l);
  const auto squaredTangent = [](glm::dvec3 d) { return (1.0 - d.z * d.z) / (d.z * d.z); };
  const double slopes = 1.0 + squaredTangent(h) / (alpha * alpha);
  const double distribution =
      1.0 / (std::numbers::pi * alpha * alpha * h.z * h.z * h.z * h.z * slopes * slopes);
  const auto lambda = [&](glm::dvec3 d) {
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * squaredTangent(d)) - 1.0);
  };
  return distribution / (1.0 + lambda(v) + lambda(l)) / (4.0 * v.z * l.z);
}

TEST(BakeLight, AFlatPatchGivesItsOwnReflectanceForEveryPair) {
  HeightField field(5, 4, 0.3f);
  for (HeightField::Sample& sample : field.samples) sample = {0.0f, {0.5f, 0.3f, 0.1f}, 0.3f, 0.35f};
  BakeOptions options;
  options.width = 4;
  options.height = 3;
  const auto baker = test::valueOf(BtfBaker::create(field, options));
  for (int view = 0; view < 81; ++view) {
    const std::vector<float> values = test::bakedView(baker, view);
    const glm::dvec3 v(options.views[static_cast<std::size_t>(view)]);
    for (std::size_t light = 0; light < 81; ++light) {
      const glm::dvec3 l(options.lights[light]);
      const double specular = std::numbers::pi * 0.3 * specularBrdf(0.35, v, l);
      for (std::size_t texel = 0; texel < 12; ++texel)
        for (std::size_t c = 0; c < 3; ++c) {
          const double albedo = std::array{0.5, 0.3, 0.1}[c];
          ASSERT_NEAR(values[(light * 12 + texel) * 3 + c], (albedo + specular) * l.z, 1e-4)
              << view << " " << light;
        }
    }
  }
}

/// A V-groove along y with faces at 45 degrees, 2 wide and 1 deep.
HeightField groove(float albedo) {
  constexpr int kColumns = 64;
  HeightField field(kColumns, 4, 2.0f / kColumns);
  for (int row = 0; row < field.rows; ++row)
    for (int column = 0; column < kColumns; ++column)
      field.at(column, row) = {static_cast<float>(std::abs(column - kColumns / 2)) * field.spacing,
                               glm::vec3(albedo), 0};
  return field;
}

TEST(BakeLight, OneBounceInAGrooveIsTheFormFactorOfTheOtherFace) {
  constexpr float kAlbedo = 0.8f;
  BakeOptions options;
  options.width = 16;
  options.height = 1;
  options.samples = 1024;
  options.views = options.lights = {{0, 0, 1}};
  const HeightField field = groove(kAlbedo);
  const std::vector<float> values = test::bakedView(test::valueOf(BtfBaker::create(field, options)), 0);
  const double direct = static_cast<double>(kAlbedo) * std::sqrt(0.5);
  for (int column = 0; column < options.width; ++column) {
    // At the distance s from the bottom, along a face of length sqrt 2, the other face fills (1 - s
    // / sqrt(s^2 + 2)) / 2 of the cosine-weighted hemisphere.
    double indirect = 0.0;
    constexpr int kSteps = 64;
    for (int step = 0; step < kSteps; ++step) {
      const double x = (column + (step + 0.5) / kSteps) / 8.0;
      double fromBottom = std::abs(x - 1.0 - 0.5 * static_cast<double>(field.spacing));
      if (fromBottom > 1.0) fromBottom = 2.0 - fromBottom;
      const double s = std::sqrt(2.0) * fromBottom;
      indirect += static_cast<double>(kAlbedo) * direct * 0.5 * (1.0 - s / std::sqrt(s * s + 2.0)) / kSteps;
    }
    EXPECT_NEAR(static_cast<double>(values[static_cast<std::size_t>(column) * 3]), direct + indirect, 0.002)
        << column;
  }
}

/// Mean over texels and colours of the radiance that a view sees under a white sky of radiance 1.
double underWhiteSky(const HeightField& field, glm::vec3 view, int bounces) {
  BakeOptions options;
  options.width = options.height = 8;
  options.bounces = bounces;
  options.samples = 8;
  options.views = {view};
  options.lights.clear();
  // Uniform in the projected disk: each light stands for an equal share of the irradiance of a sky
  // that is dark below 85 degrees, which takes 0.8 % of it.
  constexpr int kRings = 12;
  for (int ring = 0; ring < kRings; ++ring)
    for (int i = 0; i < 24; ++i) {
      const double sine = 0.996 * std::sqrt((ring + 0.5) / kRings);
      options.lights.push_back(
          directionFromDegrees(std::asin(sine) * 180.0 / std::numbers::pi, 15.0 * i + 5.0 * ring));
    }
  const std::vector<float> values = test::bakedView(test::valueOf(BtfBaker::create(field, options)), 0);
  const std::size_t perLight = values.size() / options.lights.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += static_cast<double>(values[i] / options.lights[i / perLight].z);
  return 0.992 * sum / static_cast<double>(values.size());
}

TEST(BakeLight, AWhiteGrooveUnderAWhiteSkyIsWhiteAndNeverMore) {
  for (const glm::vec3 view : {directionFromDegrees(0, 0), directionFromDegrees(60, 20)}) {
    const double value = underWhiteSky(groove(1.0f), view, 40);
    EXPECT_LT(value, 1.005);
    EXPECT_GT(value, 0.96);
  }
}

TEST(BakeLight, AGlossyWhiteGrooveReflectsNoMoreThanItReceives) {
  HeightField field = groove(0.4f);
  for (HeightField::Sample& sample : field.samples) sample.specular = 0.6f, sample.roughness = 0.4f;
  for (const glm::vec3 view : {directionFromDegrees(0, 0), directionFromDegrees(75, 20)}) {
    const double value = underWhiteSky(field, view, 40);
    EXPECT_LT(value, 1.01);
    EXPECT_GT(value, 0.7) << "GGX loses what its facets reflect more than once";
  }
}

TEST(BakeLight, MoreBouncesBringMoreLight) {
  const glm::vec3 view = directionFromDegrees(30, 20);
  const double none = underWhiteSky(groove(0.8f), view, 0);
  const double one = underWhiteSky(groove(0.8f), view, 1);
  const double two = underWhiteSky(groove(0.8f), view, 2);
  EXPECT_GT(one, none + 0.05);
  EXPECT_GT(two, one + 0.01);
  EXPECT_LT(two - one, one - none);
}

TEST(BakeLight, EqualOnAnyNumberOfThreads) {
  BakeOptions options;
  options.width = options.height = 16;
  options.bounces = 2;
  const auto bake = [&] {
    const auto baker = test::valueOf(BtfBaker::create(test::valueOf(makePattern("tiles", 64)), options));
    return test::bakedView(baker, 70);
  };
  const std::vector<float> many = bake();
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(bake(), many);
}

TEST(BakeLight, BuildingASurfaceLeavesTheProcessItsThreads) {
  const auto limit = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const std::size_t before = limit();
  const auto baker = test::valueOf(BtfBaker::create(groove(0.5f), {}));
  EXPECT_EQ(limit(), before);
}

TEST(BakeLight, RefusesWhatItCannotBake) {
  const auto reason = [](const HeightField& field, const BakeOptions& options) {
    const Result<BtfBaker> baker = BtfBaker::create(field, options);
    return baker ? std::string() : baker.error().message();
  };
  const HeightField good = groove(0.5f);
  EXPECT_EQ(reason(good, {}), "");
  EXPECT_NE(reason(good, {.width = 0}), "");
  EXPECT_NE(reason(good, {.samples = 0}), "");
  EXPECT_NE(reason(good, {.bounces = -1}), "");
  EXPECT_NE(reason(good, {.views = {}}), "");
  EXPECT_NE(reason(good, {.views = {{1, 0, 0}}}), "");
  EXPECT_NE(reason(good, {.lights = {{0, 0, 2}}}), "");
  HeightField bad = good;
  bad.at(3, 1).specular = 0.6f;
  EXPECT_NE(reason(bad, {}), "");
  bad = good;
  bad.at(3, 1).height = std::nanf("");
  EXPECT_NE(reason(bad, {}), "");
  bad = good;
  bad.at(3, 1).roughness = 0.0f;
  EXPECT_NE(reason(bad, {}), "");
  bad = good;
  bad.at(3, 1).height = 1e9f;
  EXPECT_NE(reason(bad, {}), "");
}

}  // namespace
}  // namespace weft
