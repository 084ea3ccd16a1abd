#include "weft/reflectance/LoomModel.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

constexpr int kTexelsASide = 24;
constexpr float kReliefHeight = 2.0f;

float noise(int x, int y, int which) {
  const double value = std::sin(12.9898 * ((x + kTexelsASide) % kTexelsASide) +
                                78.233 * ((y + kTexelsASide) % kTexelsASide) + 37.7 * which);
  return static_cast<float>(43758.5453 * value - std::floor(43758.5453 * value));
}

// Of a texel of the surface: three terms, and a hue that changes with the view.
glm::vec3 surface(int x, int y, glm::vec3 v, glm::vec3 l, bool isColored) {
  const glm::vec3 n = glm::normalize(glm::vec3(noise(x, y, 1) - 0.5f, noise(x, y, 2) - 0.5f, 1.5f));
  const float value = 0.15f + 0.5f * noise(x, y, 0) * std::max(glm::dot(n, l), 0.1f);
  const glm::vec3 base = isColored ? glm::vec3(1.4f, 0.9f, 0.6f) : glm::vec3(1.0f);
  const glm::vec3 hue = isColored ? glm::vec3(0.06f, 0.0f, -0.06f) * (1.0f - v.z) : glm::vec3(0.0f);
  return value * (base + hue) * l.z;
}

// Seen in relief: a view sees the texel that lies farther along it.
MemoryBtf relief(float height, bool isColored = false) {
  return MemoryBtf(kTexelsASide, kTexelsASide, [=](int x, int y, glm::vec3 v, glm::vec3 l) {
    const glm::vec2 shift = glm::round(height * reliefTangent(v));
    return surface(x + static_cast<int>(shift.x), y - static_cast<int>(shift.y), v, l, isColored);
  });
}

FitResult fitOf(const BtfSource& source, int components = 16) {
  FitOptions options;
  options.model = {"loom", {{"components", components}}};
  return valueOf(fitReflectanceField(source, options));
}

double storedError(const FitErrors& errors, ErrorMeasure measure = ErrorMeasure::Luminance) {
  return errors.of(ErrorSpace::Stored, measure).average;
}

TEST(LoomFitter, ReliefIsRegisteredAndRecovered) {
  const FitResult flat = fitOf(relief(0.0f));
  EXPECT_EQ(flat.field.model().registration().height, 0.0f);
  EXPECT_LT(storedError(flat.errors), 0.004);
  const FitResult raised = fitOf(relief(kReliefHeight));
  EXPECT_NEAR(raised.field.model().registration().height, kReliefHeight, 0.25f);
  EXPECT_LT(storedError(raised.errors), 0.004);
}

TEST(LoomFitter, HueThatChangesWithTheViewIsKept) {
  EXPECT_LT(storedError(fitOf(relief(kReliefHeight, true)).errors, ErrorMeasure::Rgb), 0.006);
}

// Half a step of what a GPU keeps of a weight is what rounding may cost.
TEST(LoomFitter, NoWeightGivesASmallerWeightedSumOfSquares) {
  for (const bool cosineInModel : {false, true}) {
    const MemoryBtf source = relief(0.0f);
    FitOptions options;
    options.model = {"loom", {{"components", 4}}};
    options.cosineInModel = cosineInModel;
    const ReflectanceField field = valueOf(fitReflectanceField(source, options)).field;
    const FieldFormula& formula = field.formula();
    const ModelledLights lights = formula.modelledLights(source.description().lights);
    std::vector<glm::vec3> values(lights.directions.size());
    const auto costOf = [&](int x, int y, std::span<const float> shared) {
      double sum = 0.0;
      for (std::size_t view = 0; view < source.description().views.size(); ++view) {
        const glm::vec3 v = source.description().views[view];
        formula.evaluateLights(shared, {}, static_cast<int>(view), lights, v, values);
        for (std::size_t i = 0; i < values.size(); ++i) {
          const float measured = luminance(surface(x, y, v, source.description().lights[i], false));
          // the display's weight
          sum += std::pow(double{luminance(values[i]) - measured}, 2.0) / (double{measured} + 0.01);
        }
      }
      return sum;
    };
    for (const auto& [x, y] : {std::pair(0, 0), {7, 11}, {20, 3}}) {
      const std::span<const float> fitted = field.shared().texel(x, y);
      std::vector<float> moved(fitted.begin(), fitted.end());
      const double least = costOf(x, y, moved);
      for (std::size_t k = 3; k < moved.size(); ++k)
        for (const float step : {-4.0f / 127, 4.0f / 127}) {
          moved[k] = fitted[k] + step;
          EXPECT_GT(costOf(x, y, moved), 0.995 * least) << k << ' ' << step << ' ' << cosineInModel;
          moved[k] = fitted[k];
        }
    }
  }
}

// Where luminance alone is there, box filtered weights are what box filtered values need.
TEST(LoomFitter, LevelsAreTheFilteredField) {
  const ReflectanceField field = fitOf(relief(0.0f)).field;
  ASSERT_EQ(field.levels().size(), 5u);  // 24 12 6 3 1
  const glm::vec3 view = field.description().views[30], light = field.description().lights[17];
  const std::span<const float> layer = field.model().commonLayer(30);
  const auto valueAt = [&](int level, int x, int y) {
    return field.formula().evaluate(field.levels()[static_cast<std::size_t>(level)].shared.texel(x, y), layer,
                                    light, view);
  };
  for (int level = 1; level < 4; ++level) {
    const int side = kTexelsASide >> level, step = 1 << level;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        glm::vec3 mean(0.0f);
        for (int j = 0; j < step; ++j)
          for (int i = 0; i < step; ++i) mean += valueAt(0, x * step + i, y * step + j);
        mean /= static_cast<float>(step * step);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(valueAt(level, x, y)[c], mean[c], 0.01f) << level;
      }
  }
  // The coarsest of 3 x 3 is the mean of all, and has the first eight weights.
  const FloatImage& finest = field.shared();
  for (int k = 3; k < 3 + 8; ++k) {
    float mean = 0.0f;
    for (int y = 0; y < kTexelsASide; ++y)
      for (int x = 0; x < kTexelsASide; ++x) mean += finest.at(x, y, k) / (kTexelsASide * kTexelsASide);
    EXPECT_NEAR(field.levels().back().shared.at(0, 0, k), mean, 0.005f);
  }
  for (int k = 3 + 8; k < finest.channelCount(); ++k)
    EXPECT_EQ(field.levels().back().shared.at(0, 0, k), 0.0f);
}

void expectFinite(const ReflectanceField& field) {
  for (const float value : field.shared().values()) ASSERT_TRUE(std::isfinite(value));
  for (const auto& [name, table] : field.tables())
    for (const float value : table.values()) ASSERT_TRUE(std::isfinite(value)) << name;
}

TEST(LoomFitter, FewDirectionsAndConstantTexelsAreDefined) {
  MemoryBtf oneView = relief(0.0f), oneLight = relief(0.0f), onePair = relief(0.0f);
  oneView.description().views.resize(1);
  oneLight.description().lights.resize(1);
  onePair.description().views.resize(1);
  onePair.description().lights.resize(1);
  const MemoryBtf grey(5, 3, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(0.4f * l.z); });
  const MemoryBtf black(5, 3, [](int, int, glm::vec3, glm::vec3) { return glm::vec3(0.0f); });
  for (const MemoryBtf& source : {oneView, oneLight, onePair, grey, black}) {
    const FitResult fit = fitOf(source, 8);
    expectFinite(fit.field);
    EXPECT_EQ(fit.field.model().registration().height, 0.0f);
    EXPECT_LT(storedError(fit.errors), 0.01);
  }
}

TEST(LoomFitter, MoreComponentsThanTexelsAreZero) {
  const MemoryBtf source(3, 2,
                         [](int x, int y, glm::vec3 v, glm::vec3 l) { return surface(x, y, v, l, false); });
  const FitResult fit = fitOf(source, 128);
  expectFinite(fit.field);
  EXPECT_LT(storedError(fit.errors), 0.004);
}

TEST(LoomFitter, ANumberOfComponentsThatIsNoMultipleOf4IsRefused) {
  const auto model = ModelRegistry::builtin().create({"loom", {{"components", 10}}});
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().message(), testing::HasSubstr("loom cannot have 10 components"));
}

TEST(LoomFitter, GivesTheSameForAnyBlocks) {
  MemoryBtf source = relief(kReliefHeight);
  source.description().height = 50;  // rows that repeat
  FitOptions options;
  options.model = {"loom", {{"components", 8}}};
  const FitResult atOnce = valueOf(fitReflectanceField(source, options));
  options.memory = std::size_t{64} << 20;  // of 94 MB, half for a block with the rows around it
  ASSERT_LT(source.rowsWithin(options.memory), 50);
  const FitResult inBlocks = valueOf(fitReflectanceField(source, options));
  EXPECT_TRUE(std::ranges::equal(atOnce.field.shared().values(), inBlocks.field.shared().values()));
  EXPECT_EQ(storedError(atOnce.errors), storedError(inBlocks.errors));
}

}  // namespace
}  // namespace weft
