#include "weft/synthesis/Synthesis.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "BakedSource.h"
#include "SyntheticSample.h"
#include "weft/baking/Pattern.h"
#include "weft/core/Direction.h"
#include "weft/synthesis/SynthesisQuality.h"

namespace weft {
namespace {

using test::noiseAt;
using test::sampleOf;
using test::valueOf;

constexpr double kPeriod = 11.0;

// Slanted ribs of a period that no size is a multiple of, with something of its own in each texel.
AppearanceSample ribs() {
  return sampleOf(64, 64, 3, [](int x, int y, int d) {
    const double phase = 2.0 * std::numbers::pi * (x + 0.1 * y) / kPeriod;
    return static_cast<float>(d == 0   ? std::cos(phase)
                              : d == 1 ? std::sin(phase)
                                       : 0.0) +
           0.2f * noiseAt(x, y, d);
  });
}

CoordinateMap mapOf(const AppearanceSample& sample, int width, int height, SynthesisOptions options = {}) {
  options.width = width;
  options.height = height;
  return valueOf(synthesize(sample, options)).map;
}

/// Steps of a phase from -1/2 to 1/2 between neighbours that are farther than a quarter from what a
/// whole number of periods round the torus makes them.
template <class Phase>
int brokenSteps(const CoordinateMap& map, glm::dvec2 wave, const Phase& phaseOf) {
  int broken = 0;
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
        const glm::ivec2 next((x + step.x) % map.width(), (y + step.y) % map.height());
        const double off =
            phaseOf(map.at(next.x, next.y)) - phaseOf(map.at(x, y)) - wave.x * step.x - wave.y * step.y;
        broken += std::abs(off - std::round(off)) > 0.25;
      }
  return broken;
}

TEST(Synthesis, PatchesKeepRibsWholeRoundTheTorusAndRepeatNothingElse) {
  const AppearanceSample sample = ribs();
  const CoordinateMap map = mapOf(sample, 160, 120);
  const auto phaseOf = [](glm::ivec2 texel) { return (texel.x + 0.1 * texel.y) / kPeriod; };
  EXPECT_EQ(brokenSteps(map, {1.0 / kPeriod, 0.1 / kPeriod}, phaseOf), 0);
  const SeamVisibility seams = seamVisibility(sample, map);
  for (const double visible : seams.mean) EXPECT_LE(visible, 1.1);
  EXPECT_GT(seams.jumps, 0.0);
  const Repetition repeated = repetition(sample, map);
  EXPECT_LE(repeated.beyondSample(), 0.6);
  EXPECT_LE(repeated.copied, 0.4);
}

TEST(Synthesis, ASurfaceAsLargeAsTheSampleTilesAndTheSampleDoesNot) {
  const AppearanceSample sample = ribs();
  const CoordinateMap map = mapOf(sample, 64, 64);
  const CoordinateMap tiled = valueOf(tiledMap(64, 64, sample));
  EXPECT_GT(seamVisibility(sample, tiled).mean[0], 1.5);
  EXPECT_LT(seamVisibility(sample, map).mean[0], 1.1);
}

TEST(Synthesis, TheBakedCorduroyHasNoBrokenRib) {
  BakeOptions bake;
  bake.width = bake.height = 48;
  bake.samples = 1;
  bake.views = {directionFromDegrees(0, 0), directionFromDegrees(60, 0), directionFromDegrees(60, 120)};
  bake.lights = {directionFromDegrees(15, 0), directionFromDegrees(60, 60), directionFromDegrees(60, 200)};
  const test::BakedSource source(valueOf(makePattern("corduroy", 192)), bake);
  const AppearanceSample sample = valueOf(appearanceOf(source, 1 << 30, {}));
  EXPECT_TRUE(sample.repeats);
  const CoordinateMap map = mapOf(sample, 256, 256);
  EXPECT_EQ(brokenSteps(map, {3.0 / 48, 0.0}, [](glm::ivec2 texel) { return texel.x * 3.0 / 48; }), 0);
  for (const double visible : seamVisibility(sample, map).mean) EXPECT_LE(visible, 1.1);
  EXPECT_LE(repetition(sample, map).beyondSample(), 0.6);
}

TEST(Synthesis, EqualInputGivesEqualMapsOnAnyNumberOfThreads) {
  const AppearanceSample sample = ribs();
  for (const SynthesisMethod method :
       {SynthesisMethod::Patches, SynthesisMethod::KCoherence, SynthesisMethod::JumpMap}) {
    SynthesisOptions options{.method = method, .textons = 100};
    const auto texelsOn = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const CoordinateMap map = mapOf(sample, 50, 37, options);
      return std::vector<glm::u16vec2>(map.texels().begin(), map.texels().end());
    };
    const auto one = texelsOn(1);
    EXPECT_TRUE(one == texelsOn(4)) << name(method);
    options.seed = 2;
    EXPECT_FALSE(one == texelsOn(1)) << name(method);
  }
}

TEST(Synthesis, KCoherenceContinuesWhatIsBesideBetterThanJumpsDo) {
  const AppearanceSample sample = ribs();
  const auto seams = [&](SynthesisOptions options) {
    return seamVisibility(sample, mapOf(sample, 96, 96, options));
  };
  const SeamVisibility coherent = seams({.method = SynthesisMethod::KCoherence, .textons = 400});
  EXPECT_LT(coherent.mean[0], seams({.method = SynthesisMethod::JumpMap, .textons = 400}).mean[0]);
  EXPECT_LT(coherent.mean[0], 1.5);
}

TEST(Synthesis, TexelsOfTheMarginAreNoSources) {
  AppearanceSample sample = ribs();
  sample.margin = 9;
  for (const SynthesisMethod method :
       {SynthesisMethod::Patches, SynthesisMethod::KCoherence, SynthesisMethod::JumpMap}) {
    const CoordinateMap map = mapOf(sample, 40, 40, {.method = method, .textons = 50});
    for (const glm::u16vec2 texel : map.texels())
      ASSERT_TRUE(texel.x >= 9 && texel.y >= 9 && texel.x < 55 && texel.y < 55) << name(method);
  }
}

// Every number of textons is more than there are different texels.
// It has fewer offsets than the row has patches.
TEST(Synthesis, ASmallSampleMakesAWideSurface) {
  const auto value = [](int x, int y, int d) { return noiseAt(x, y, d); };
  EXPECT_EQ(mapOf(sampleOf(12, 12, 3, value), 640, 16).width(), 640);
}

TEST(Synthesis, SourcesLieAllOverAnIrregularSample) {
  const auto value = [](int x, int y, int d) { return noiseAt(x, y, d); };
  const CoordinateMap map = mapOf(sampleOf(96, 96, 3, value), 192, 192);
  const auto below = std::ranges::count_if(map.texels(), [](const auto& texel) { return texel.y >= 56; });
  EXPECT_GT(below, std::ssize(map.texels()) / 5);
}

TEST(Synthesis, OneColourAndFewTexelsAreDefined) {
  const AppearanceSample one = sampleOf(16, 12, 1, [](int, int, int) { return 0.5f; });
  for (const SynthesisMethod method :
       {SynthesisMethod::Patches, SynthesisMethod::KCoherence, SynthesisMethod::JumpMap}) {
    const Synthesis made = valueOf(synthesize(one, {.method = method, .width = 8, .height = 300}));
    EXPECT_EQ(made.map.height(), 300);
    EXPECT_EQ(seamVisibility(one, made.map).mean[0], 0.0);
    if (method != SynthesisMethod::Patches) {
      EXPECT_THAT(made.warnings, testing::Contains(testing::HasSubstr("1 different texels")));
    }
  }
}

TEST(Synthesis, WhatCannotBeDoneIsSaid) {
  const auto messageOf = [](const AppearanceSample& sample, const SynthesisOptions& options) {
    const Result<Synthesis> made = synthesize(sample, options);
    return made ? std::string("made") : made.error().message();
  };
  const AppearanceSample small = sampleOf(11, 40, 1, [](int x, int, int) { return static_cast<float>(x); });
  EXPECT_THAT(messageOf(small, {.width = 64, .height = 64}), testing::HasSubstr("11 x 40 sources"));
  const AppearanceSample sample = ribs();
  EXPECT_THAT(messageOf(sample, {.width = 7, .height = 64}), testing::HasSubstr("is 7"));
  EXPECT_THAT(messageOf(sample, {.width = 64, .height = 20000}), testing::HasSubstr("is 20000"));
  EXPECT_THAT(messageOf(sample, {.width = 64, .height = 64, .k = 11}), testing::HasSubstr("k is 11"));
  EXPECT_THAT(messageOf(sample, {.width = 64, .height = 64, .neighborhood = 4}), testing::HasSubstr("is 4"));
  EXPECT_THAT(messageOf(sample, {.width = 64, .height = 64, .textons = 0}),
              testing::HasSubstr("textons is 0"));
  EXPECT_THAT(valueOf(synthesize(sample, {.width = 18, .height = 64})).warnings,
              testing::Contains(testing::HasSubstr("repeats itself every")));
}

}  // namespace
}  // namespace weft
