#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "Lattice.h"
#include "MemoryBtf.h"
#include "PatchCut.h"
#include "SimilarNeighborhoods.h"
#include "SyntheticSample.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"
#include "weft/synthesis/SynthesisQuality.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::noiseAt;
using test::sampleOf;
using test::valueOf;

TEST(Textons, StandForClustersAndKeepTheirDistances) {
  // Four clusters at the corners of a rectangle of 1 x 2, a little spread.
  const AppearanceSample sample = sampleOf(20, 20, 2, [](int x, int y, int d) {
    return static_cast<float>(d == 0 ? x / 10 : 2 * (y / 10)) + 0.01f * noiseAt(x, y, d);
  });
  const Textons textons = findTextons(sample.vectors, 4);
  ASSERT_EQ(textons.count, 4);
  const auto distance = [&](int x0, int y0, int x1, int y1) {
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(20 * y + x); };
    return textons.distancesFrom(at(x0, y0))[textons.ofTexel[at(x1, y1)]];
  };
  EXPECT_EQ(distance(2, 3, 9, 9), 0.0f);
  EXPECT_NEAR(distance(2, 3, 12, 4), 1.0f, 0.05f);
  EXPECT_NEAR(distance(2, 3, 5, 14), 4.0f, 0.05f);
  EXPECT_NEAR(distance(15, 3, 5, 14), 5.0f, 0.05f);
  EXPECT_EQ(findTextons(sample.vectors, 100000).count, 400);
}

TEST(SimilarNeighborhoods, AreThoseThatComparingAllFinds) {
  const AppearanceSample sample = sampleOf(19, 23, 2, noiseAt);
  const AnalysedLayer layer = analyseLayer(sample.vectors, 2, 60);
  const auto distance = [&](int p, int q) {
    float sum = 0.0f;
    for (int dy = -2; dy <= 0; ++dy)
      for (int dx = -2; dx <= (dy == 0 ? -1 : 2); ++dx) {
        const int offset = dy * layer.width + dx;
        sum += layer.textons.distancesFrom(static_cast<std::size_t>(
            p + offset))[layer.textons.ofTexel[static_cast<std::size_t>(q + offset)]];
      }
    return sum;
  };
  for (const auto& [x, y] : {std::pair(2, 2), {9, 15}, {16, 20}, {7, 16}}) {
    const int p = y * layer.width + x;
    std::vector<float> all;
    for (int row = 2; row < layer.height - 2; ++row)
      for (int column = 2; column < layer.width - 2; ++column)
        if (const int q = row * layer.width + column; q != p) all.push_back(distance(p, q));
    std::sort(all.begin(), all.end());
    float before = 0.0f;
    for (int i = 0; i < kSimilarTexels; ++i) {
      const auto at = static_cast<std::size_t>(p * kSimilarTexels + i);
      EXPECT_NEAR(distance(p, layer.similar[at]), all[static_cast<std::size_t>(i)], 1e-4f) << i;
      EXPECT_GT(layer.probability[at], before);
      before = layer.probability[at];
    }
    EXPECT_EQ(before, 1.0f);
  }
}

Lattice latticeOf(const std::function<float(int x, int y)>& value) {
  const AppearanceSample sample =
      sampleOf(70, 60, 1, [&](int x, int y, int) { return value(x, y) + 0.5f * noiseAt(x, y, 0); });
  return findLattice(sample.vectors, {2, 3, 64, 50});
}

TEST(Lattice, HasTheWavesOfRibsAndStitchesAndNoneOfFelt) {
  const auto wave = [](double phase) { return static_cast<float>(std::cos(2.0 * std::numbers::pi * phase)); };
  EXPECT_TRUE(latticeOf([](int, int) { return 0.0f; }).waves.empty());
  const Lattice ribs = latticeOf([&](int x, int y) { return wave(x / 13.4 + y / 90.0); });
  ASSERT_EQ(ribs.waves.size(), 1u);
  EXPECT_LT(glm::distance(ribs.waves[0], glm::dvec2(1 / 13.4, 1 / 90.0)), 0.002);
  const Lattice stitches = latticeOf([&](int x, int y) { return wave(x / 13.4) + 0.6f * wave(y / 9.2); });
  ASSERT_EQ(stitches.waves.size(), 2u);
  EXPECT_LT(glm::distance(stitches.waves[0], glm::dvec2(1 / 13.4, 0)), 0.002);
  EXPECT_LT(std::abs(std::abs(stitches.waves[1].y) - 1 / 9.2), 0.002);
  // 67 texels are five periods of 13.4; 60 are as near to four as to five, of 15 and 12.
  EXPECT_NEAR(fitted(ribs, 67, 90).waves[0].x, 5.0 / 67, 1e-9);
}

TEST(PatchCut, FollowsWhereNothingDiffers) {
  // A slanted line through the strip at the left, and a straight one through that at the bottom.
  const auto onLine = [](int x, int y) { return std::abs(x - (2 + y / 5)) <= 1 || (y >= 26 && y <= 27); };
  const PatchCut cut = cutPatch({30, 30}, {.left = true, .bottom = true, .width = 9},
                                [&](int x, int y) { return onLine(x, y) ? 0.0f : 1.0f; });
  EXPECT_EQ(cut.cost, 0.0);
  const auto taken = [&](int x, int y) { return cut.taken[static_cast<std::size_t>(30 * y + x)] != 0; };
  for (int y = 0; y < 26; ++y) {
    EXPECT_FALSE(taken(y / 5, y));
    EXPECT_TRUE(taken(4 + y / 5, y));
  }
  for (int x = 12; x < 30; ++x) {
    EXPECT_TRUE(taken(x, 25));
    EXPECT_FALSE(taken(x, 28));
  }
}

TEST(SeamVisibility, IsTheDifferenceAtJumpsInUnitsOfTheSample) {
  // Steps of 1 along x, and 2 along y.
  const AppearanceSample sample =
      sampleOf(32, 32, 1, [](int x, int y, int) { return static_cast<float>(x + 2 * y); });
  std::vector<glm::u16vec2> texels;
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) texels.emplace_back(x < 6 ? 2 + x : 5 + x, 3 + y);
  const SeamVisibility seams = seamVisibility(sample, valueOf(CoordinateMap::create(12, 12, 32, 32, texels)));
  // 12 jumps by 3 columns too many, 12 back by 15, 12 back by 12 rows: over steps of 1 and 2.
  EXPECT_NEAR(seams.jumps, 36.0 / 288.0, 1e-9);
  EXPECT_NEAR(seams.mean[0], (12 * 3 + 12 * 15 + 12 * 24) / (24.0 * 1 + 12.0 * 2), 1e-6);
}

TEST(Repetition, OfATiledSampleIsWhole) {
  const AppearanceSample sample = sampleOf(20, 20, 2, noiseAt);
  const Repetition tiled = repetition(sample, valueOf(tiledMap(60, 40, sample)));
  EXPECT_NEAR(tiled.correlation, 1.0, 1e-6);
  EXPECT_NEAR(tiled.copied, 1.0, 1e-6);
  EXPECT_NEAR(tiled.beyondSample(), 1.0, 1e-6);
  EXPECT_LT(tiled.ofSample, 0.5);
  EXPECT_LT(repetition(sample, valueOf(tiledMap(20, 20, sample))).beyondSample(), 0.5);
}

// --- Appearance ---

glm::vec3 surface(int x, int y, glm::vec3 v, glm::vec3 l) {
  const glm::vec3 n = glm::normalize(glm::vec3(0.6f * noiseAt(x, y, 0), 0.6f * noiseAt(x, y, 1), 1.0f));
  const float shade =
      (0.3f + 0.15f * noiseAt(x, y, 2)) * std::max(glm::dot(n, l), 0.0f) * (0.5f + 0.5f * v.z);
  return shade * glm::vec3(1.2f, 1.0f + 0.3f * noiseAt(x, y, 3), 0.5f);
}

double storedDifference(const MemoryBtf& btf, glm::ivec2 a, glm::ivec2 b) {
  double sum = 0.0, count = 0.0;
  for (const glm::vec3 view : btf.description().views)
    for (const glm::vec3 light : btf.description().lights) {
      const glm::vec3 d = encode(Encoding::Gamma22, surface(a.x, a.y, view, light)) -
                          encode(Encoding::Gamma22, surface(b.x, b.y, view, light));
      sum += double{glm::dot(d, d)};
      count += 3.0;
    }
  return std::sqrt(sum / count);
}

TEST(Appearance, DistancesAreThoseOfAllImagesAndThoseOfLoomClose) {
  MemoryBtf btf(24, 24, surface);
  // One view and a sixth of the lights: enough, and soon read.
  auto& lights = btf.description().lights;
  for (std::size_t i = 0; 6 * i < lights.size(); ++i) lights[i] = lights[6 * i];
  lights.resize(lights.size() / 6);
  auto& views = btf.description().views;
  views = {views[0], views[10], views[40], views[60], views[80]};
  const AppearanceSample all = valueOf(appearanceOf(btf, 100'000, {}));
  EXPECT_GT(all.keptVariance, 0.98);
  FitOptions options;
  options.model = {"loom", {{"components", 12}}};
  const AppearanceSample loom = valueOf(appearanceOf(valueOf(fitReflectanceField(btf, options)).field));
  double ofAll = 0.0, ofLoom = 0.0, sum = 0.0;
  for (int i = 0; i < 60; ++i) {
    const glm::ivec2 a(i % 24, 7 * i % 24), b(11 * i % 24, (5 * i + 3) % 24);
    const double expected = storedDifference(btf, a, b);
    ofAll += std::abs(double{all.vectors.distance(a.x, a.y, b.x, b.y)} - expected);
    ofLoom += std::abs(double{loom.vectors.distance(a.x, a.y, b.x, b.y)} - expected);
    sum += expected;
  }
  EXPECT_LT(ofAll, 0.01 * sum);
  EXPECT_LT(ofLoom, 0.3 * sum);
  EXPECT_FALSE(appearanceOf(btf, 100'000, {}, {80.0f, 90.0f}));
}

}  // namespace
}  // namespace weft
