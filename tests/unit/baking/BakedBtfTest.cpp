#include "weft/baking/BakedBtf.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "Samples.h"
#include "TestSupport.h"
#include "weft/baking/Pattern.h"
#include "weft/core/Direction.h"
#include "weft/measurement/BtfSource.h"

namespace weft {
namespace {

BakeOptions fewDirections() {
  const std::vector<glm::vec3> all = ubo2003Directions();
  BakeOptions options;
  options.width = options.height = 16;
  options.views = options.lights = std::vector<glm::vec3>(all.begin(), all.begin() + 7);
  return options;
}

BtfBaker flatBaker(float albedo, float specular, const BakeOptions& options) {
  HeightField field(4, 4, 1.0f);
  for (HeightField::Sample& sample : field.samples) sample = {0.0f, glm::vec3(albedo), specular, 0.2f};
  return test::valueOf(BtfBaker::create(field, options));
}

TEST(BakedBtf, TheClippedShareCountsValuesAboveOne) {
  BakeOptions options = fewDirections();
  options.lights = {directionFromDegrees(0, 0), directionFromDegrees(60, 0)};  // values .5 and .25
  const auto baked = test::valueOf(BakedBtf::bake(flatBaker(0.5f, 0.0f, options), test::testFolder()));
  EXPECT_EQ(baked.clippedShare(1.0f), 0.0);
  EXPECT_EQ(baked.clippedShare(3.0f), 0.5);
  EXPECT_EQ(baked.clippedShare(5.0f), 1.0);
  EXPECT_EQ(baked.scaleFor(0.001), 1.0f) << "a dark material must stay dark";
}

TEST(BakedBtf, TheScaleClipsAsManyValuesAsAllowedAndNoFewer) {
  BakeOptions options = fewDirections();
  options.lights = ubo2003Directions();
  options.views = {directionFromDegrees(0, 0)};
  const auto baked = test::valueOf(BakedBtf::bake(flatBaker(0.2f, 0.8f, options), test::testFolder()));
  // Seen from above, the seven lights within 15 degrees are brighter than 1, the central one most.
  const float allFit = baked.scaleFor(0.0);
  EXPECT_NEAR(allFit, 1.0 / (0.2 + 0.8 / (4 * 0.2 * 0.2)), 1e-3);
  EXPECT_EQ(baked.clippedShare(allFit), 0.0);
  EXPECT_GT(baked.clippedShare(1.001f * allFit), 0.0);
  const float oneClips = baked.scaleFor(1.5 / 81.0);
  EXPECT_GT(oneClips, 1.5f * allFit);
  EXPECT_NEAR(baked.clippedShare(oneClips), 1.0 / 81.0, 1e-9);
}

TEST(BakedBtf, TheZipReadsBackAsWhatWasBaked) {
  const std::filesystem::path folder = test::testFolder();
  const BtfBaker baker =
      test::valueOf(BtfBaker::create(test::valueOf(makePattern("weave", 64)), fewDirections()));
  auto baked = test::valueOf(BakedBtf::bake(baker, folder));
  ASSERT_TRUE(baked.writeZip(folder / "weave.zip", "weave", 0.9f));
  const auto btf = test::valueOf(openBtf(folder / "weave.zip"));
  EXPECT_EQ(btf->description().width, 16);
  EXPECT_TRUE(btf->description().cosineInData);
  ASSERT_EQ(btf->description().views.size(), 7u);
  std::vector<float> expected(7 * 16 * 16 * 3);
  const SampleRows actual = test::allRows(*btf);
  for (int view = 0; view < 7; ++view) {
    EXPECT_LT(glm::distance(btf->description().views[static_cast<std::size_t>(view)],
                            baker.options().views[static_cast<std::size_t>(view)]),
              1e-5f);
    baker.bakeView(view, expected);
    double error = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) {  // [light][row][column][rgb]
      const int x = static_cast<int>(i / 3 % 16);
      const int y = static_cast<int>(i / 3 / 16 % 16);
      const std::size_t pair = static_cast<std::size_t>(view) * 7 + i / (3 * 16 * 16);
      const float read = test::linearSample(actual, x, y, pair)[static_cast<int>(i % 3)];
      error += static_cast<double>(std::abs(encode(Encoding::Gamma22, std::min(0.9f * expected[i], 1.0f)) -
                                            encode(Encoding::Gamma22, read)));
    }
    EXPECT_LT(error / static_cast<double>(expected.size()), 0.02) << "JPEG of quality 95";
  }
  // No scratch file and no temporary is left beside it.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(BakedBtf, AFolderThatDoesNotExistIsNamed) {
  const Result<BakedBtf> baked = BakedBtf::bake(flatBaker(0.5f, 0.0f, fewDirections()), "/no/such/folder");
  ASSERT_FALSE(baked);
  EXPECT_EQ(baked.error().where, "/no/such/folder");
}

}  // namespace
}  // namespace weft
