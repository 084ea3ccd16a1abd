#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"
#include "weft/reflectance/LevelSum.h"
#include "weft/reflectance/LodModel.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

float hashed(int a, int b, int c) {
  auto bits = static_cast<std::uint32_t>(a) * 73856093u ^ static_cast<std::uint32_t>(b) * 19349663u ^
              static_cast<std::uint32_t>(c) * 83492791u;
  bits = (bits ^ (bits >> 15)) * 0x85ebca6bu;
  bits = (bits ^ (bits >> 13)) * 0xc2b2ae35u;
  return static_cast<float>((bits ^ (bits >> 16)) >> 8) * 0x1p-24f;
}

/// Three numbers a texel, times functions of the directions.
glm::vec3 lowRank(int x, int y, glm::vec3 v, glm::vec3 l) {
  const float relief = 0.4f * (hashed(x, y, 0) - 0.5f) * l.x + 0.3f * (hashed(x, y, 1) - 0.5f) * v.y;
  return l.z * (glm::vec3(0.5f, 0.4f, 0.3f) * (0.6f + 0.5f * hashed(x, y, 2)) + glm::vec3(relief));
}

/// With the 37 directions up to 45 degrees.
MemoryBtf lowRankBtf(int width, int height) {
  MemoryBtf source(width, height, lowRank);
  source.description().views.resize(37);
  source.description().lights.resize(37);
  return source;
}

FitResult lodFit(const BtfSource& source, int components = 8, int chroma = 2, FitOptions options = {}) {
  options.model = {"lod", {{"components", components}, {"chroma", chroma}}};
  return valueOf(fitReflectanceField(source, options));
}

double storedRgb(const FitErrors& errors) {
  return errors.of(ErrorSpace::Stored, ErrorMeasure::Rgb).average;
}

// Whatever the measurement: here no two numbers of it have to do with each other. What is left is
// the rounding of weights to bytes.
TEST(LodFitter, AllComponentsGiveTheMeasurementBack) {
  MemoryBtf source(12, 10, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    const int pair = static_cast<int>(100.0f * (v.x + 2.0f * v.y) + 1000.0f * (l.x + 3.0f * l.y));
    return 0.3f +
           0.4f * glm::vec3(hashed(x, y, 3 * pair), hashed(x, y, 3 * pair + 1), hashed(x, y, 3 * pair + 2));
  });
  source.description().views.resize(4);
  source.description().lights.resize(4);
  FitOptions stored;
  stored.space = FitSpace::Stored;
  EXPECT_LT(storedRgb(lodFit(source, 16, 16, stored).errors), 0.003);
  EXPECT_LT(storedRgb(lodFit(source, 16, 16).errors), 0.004);
  EXPECT_GT(storedRgb(lodFit(source, 4, 2).errors), 0.05) << "fewer cannot";
}

TEST(LodFitter, AMeasurementOfLowRankIsRecovered) {
  const FitResult fit = lodFit(lowRankBtf(37, 50));
  ASSERT_EQ(fit.field.levels().size(), 5u);
  EXPECT_LT(storedRgb(fit.errors), 0.004);
}

TEST(LodFitter, LevelsShowTheFilteredMeasurement) {
  const MemoryBtf source = lowRankBtf(24, 24);
  const ReflectanceField field = lodFit(source).field;
  const glm::vec3 view = field.description().views[30], light = field.description().lights[17];
  std::vector<float> numbers;
  for (int level = 0; level < static_cast<int>(field.levels().size()); ++level) {
    const int side = 24 >> level, step = 1 << level;
    double errors = 0.0, bias = 0.0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        glm::vec3 mean(0.0f);
        for (int j = 0; j < step; ++j)
          for (int i = 0; i < step; ++i)
            mean += lowRank(x * step + i, y * step + j, view, light) / static_cast<float>(step * step);
        const glm::vec2 middle = (glm::vec2(x, y) + 0.5f) * static_cast<float>(step) - 0.5f;
        numbersOfLevels(field.levels(), middle, static_cast<float>(level), numbers);
        const glm::vec3 shown =
            field.formula().evaluate(numbers, field.formula().layerOf({}, 30), light, view);
        for (int c = 0; c < 3; ++c) {
          EXPECT_NEAR(shown[c], mean[c], 0.015f) << level;
          errors += std::abs(double{shown[c] - mean[c]}) / (3.0 * side * side);
          bias += double{shown[c] - mean[c]} / (3.0 * side * side);
        }
      }
    EXPECT_LT(errors, 0.003) << level;
    EXPECT_NEAR(bias, 0.0, 0.001) << level;
  }
}

void expectFiniteField(const ReflectanceField& field) {
  for (const FieldLevel& level : field.levels())
    for (const float value : level.shared.values()) ASSERT_TRUE(std::isfinite(value));
  for (const auto& [name, table] : field.tables())
    for (const float value : table.values()) ASSERT_TRUE(std::isfinite(value)) << name;
}

TEST(LodFitter, FewDirectionsAndConstantTexelsAreDefined) {
  MemoryBtf oneView = lowRankBtf(6, 5), oneLight = oneView, onePair = oneView;
  oneView.description().views.resize(1);
  oneLight.description().lights.resize(1);
  onePair.description().views.resize(1);
  onePair.description().lights.resize(1);
  const MemoryBtf grey(5, 3, [](int, int, glm::vec3, glm::vec3 l) { return glm::vec3(0.4f * l.z); });
  const MemoryBtf black(5, 3, [](int, int, glm::vec3, glm::vec3) { return glm::vec3(0.0f); });
  for (const MemoryBtf& source : {oneView, oneLight, onePair, grey, black, lowRankBtf(1, 1)}) {
    const FitResult fit = lodFit(source);
    expectFiniteField(fit.field);
    EXPECT_LT(storedRgb(fit.errors), 0.01);
  }
}

TEST(LodFitter, GivesTheSameForAnyBlocks) {
  const MemoryBtf source(24, 38, lowRank);
  FitOptions options;
  const FitResult atOnce = lodFit(source, 4, 2, options);
  options.memory = std::size_t{64} << 20;  // of 72 MB
  ASSERT_LT(source.rowsWithin(options.memory), 38);
  const FitResult inBlocks = lodFit(source, 4, 2, options);
  for (std::size_t i = 0; i < atOnce.field.levels().size(); ++i)
    EXPECT_TRUE(std::ranges::equal(atOnce.field.levels()[i].shared.values(),
                                   inBlocks.field.levels()[i].shared.values()));
  EXPECT_TRUE(std::ranges::equal(atOnce.field.tables().at("eigen_brdfs").values(),
                                 inBlocks.field.tables().at("eigen_brdfs").values()));
  EXPECT_EQ(storedRgb(atOnce.errors), storedRgb(inBlocks.errors));
}

}  // namespace
}  // namespace weft
