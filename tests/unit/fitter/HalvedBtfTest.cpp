// What coarser levels are fitted to.
#include "HalvedBtf.h"

#include <gtest/gtest.h>

#include "MemoryBtf.h"
#include "TestSupport.h"
#include "weft/fitter/FieldFit.h"

namespace weft {
namespace {

using test::MemoryBtf;
using test::valueOf;

glm::vec3 unevenValue(int x, int y, glm::vec3 v, glm::vec3 l) {
  const float value =
      (0.1f * static_cast<float>((13 * x + 7 * y) % 17) + 0.1f * v.x + 0.2f * l.x * l.y) * l.z;
  return {0.2f + 0.4f * value, 1e-3f + value * value, 0.3f};
}

MemoryBtf fewPairs(int width, int height) {
  MemoryBtf btf(width, height, unevenValue);
  btf.description().views.resize(3);
  btf.description().lights.resize(9);
  return btf;
}

// What the box of a coarser texel covers.
glm::vec3 averageOfBox(const Crop& crop, glm::ivec2 coarse, glm::ivec2 texel, glm::vec3 v, glm::vec3 l) {
  constexpr int kParts = 840;  // of a finer texel: a multiple of all sides here
  const glm::ivec2 side(crop.width * kParts / coarse.x, crop.height * kParts / coarse.y);
  glm::dvec3 sum(0.0);
  for (int y = 0; y < crop.height; ++y)
    for (int x = 0; x < crop.width; ++x) {
      const auto covered = [&](int fine, int from, int to) {
        return std::max(0, std::min((fine + 1) * kParts, to) - std::max(fine * kParts, from));
      };
      const double share = covered(x, texel.x * side.x, (texel.x + 1) * side.x) /
                           static_cast<double>(side.x) *
                           covered(y, texel.y * side.y, (texel.y + 1) * side.y) / static_cast<double>(side.y);
      if (share > 0.0) sum += share * glm::dvec3(unevenValue(crop.x + x, crop.y + y, v, l));
    }
  return glm::vec3(sum);
}

std::vector<float> allOf(const BtfSource& source) {
  SampleRows rows;
  test::requireDone(source.readRows(0, source.description().height, rows));
  return {rows.floats().begin(), rows.floats().end()};
}

TEST(HalvedBtf, AveragesWhatCoarserTexelsCover) {
  const MemoryBtf source = fewPairs(12, 11);
  const BtfDescription& d = source.description();
  for (const Crop crop : {Crop{0, 0, 12, 10}, Crop{1, 2, 7, 5}, Crop{3, 0, 1, 3}, Crop{2, 1, 5, 1}}) {
    const HalvedBtf halved(source, crop, std::size_t{64} << 20);
    const glm::ivec2 size(halved.description().width, halved.description().height);
    EXPECT_EQ(size, glm::ivec2(std::max(crop.width / 2, 1), std::max(crop.height / 2, 1)));
    const std::vector<float> values = allOf(halved);
    std::size_t next = 0;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        for (const glm::vec3 view : d.views)
          for (const glm::vec3 light : d.lights) {
            const glm::vec3 expected = averageOfBox(crop, size, {x, y}, view, light);
            for (int c = 0; c < 3; ++c, ++next)
              ASSERT_NEAR(values[next], expected[c], 1e-5f) << x << ' ' << y;
          }
  }
}

TEST(HalvedBtf, IsTheSameKeptOrReadInPieces) {
  const MemoryBtf source = fewPairs(11, 13);
  const Crop crop{0, 0, 11, 13};
  const HalvedBtf inPieces(source, crop, 1);  // a row at once
  const std::vector<float> expected = allOf(inPieces);
  HalvedBtf kept(source, crop, std::size_t{64} << 20);
  test::requireDone(kept.keep());
  EXPECT_EQ(allOf(kept), expected);
  HalvedBtf keptFrom(source, crop, std::size_t{64} << 20);
  SampleWindow window;
  test::requireDone(window.read(source, crop, 0, 13, 0));
  test::requireDone(keptFrom.keepFrom(window));
  EXPECT_EQ(allOf(keptFrom), expected);
  SampleRows some;
  test::requireDone(kept.readRows(4, 2, some));
  const std::size_t ofRow = expected.size() / 6;
  EXPECT_TRUE(std::ranges::equal(some.floats(), std::span(expected).subspan(4 * ofRow, 2 * ofRow)));
}

// A source of bytes: linear averages, not those of stored values.
TEST(HalvedBtf, AveragesLightAndNotWhatIsStored) {
  class Checkered : public BtfSource {
   public:
    Checkered() {
      description_.width = description_.height = 2;
      description_.views = description_.lights = {{0, 0, 1}};
      description_.encoding = Encoding::Gamma22;
      description_.storedAsBytes = true;
    }
    const BtfDescription& description() const override { return description_; }
    Result<void> readRows(int firstRow, int rowCount, SampleRows& rows) const override {
      WEFT_TRY_VOID(rows.allocate(description_, rowCount));
      for (int i = 0; i < rowCount * 6; ++i)
        rows.bytes()[static_cast<std::size_t>(i)] = (firstRow + i / 3) % 2 == 0 ? 255 : 0;
      return {};
    }

   private:
    BtfDescription description_;
  };
  const Checkered source;
  const HalvedBtf halved(source, {0, 0, 2, 2}, 1);
  SampleRows rows;
  test::requireDone(halved.readRows(0, 1, rows));
  EXPECT_EQ(rows.bytes()[0], 186);  // 255 * 0.5^(1/2.2)
}

// Each level is what a fit of the averaged measurement gives.
TEST(HalvedBtf, LevelsAreFitsOfAverages) {
  const MemoryBtf source(6, 4, unevenValue);
  const MemoryBtf averaged(3, 2, [](int x, int y, glm::vec3 v, glm::vec3 l) {
    return averageOfBox({0, 0, 6, 4}, {3, 2}, {x, y}, v, l);
  });
  FitOptions options;
  options.model.name = "rfp";
  options.precision = Precision::Float;
  const ReflectanceField field = valueOf(fitReflectanceField(source, options)).field;
  const ReflectanceField direct = valueOf(fitReflectanceField(averaged, options)).field;
  ASSERT_EQ(field.levels().size(), 3u);
  for (std::size_t i = 1; i < 3; ++i) {
    const FieldLevel &level = field.levels()[i], &wanted = direct.levels()[i - 1];
    ASSERT_EQ(level.layers.values().size(), wanted.layers.values().size());
    for (std::size_t n = 0; n < level.shared.values().size(); ++n)
      EXPECT_NEAR(level.shared.values()[n], wanted.shared.values()[n], 1e-4f);
    for (std::size_t n = 0; n < level.layers.values().size(); ++n)
      ASSERT_NEAR(level.layers.values()[n], wanted.layers.values()[n], 1e-3f);
  }
}

}  // namespace
}  // namespace weft
