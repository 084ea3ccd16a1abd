#include "weft/measurement/BtfWriter.h"

#include <gmock/gmock.h>
#include <zip.h>

#include <cmath>

#include "Samples.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::requireDone;
using test::valueOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kSize = 8;

BtfDescription description() {
  BtfDescription d;
  d.width = kSize;
  d.height = kSize;
  d.views = {directionFromDegrees(0, 0), directionFromDegrees(15, 60), directionFromDegrees(37.5, 352.5)};
  d.lights = {directionFromDegrees(0, 0), directionFromDegrees(75, 345)};
  d.encoding = Encoding::Gamma22;
  d.name = "STRIPES";
  return d;
}

// Columns alternate between red and blue, which chroma subsampling would mix.
float madeUpValue(int view, int light, std::size_t texel, std::size_t c) {
  const std::size_t bright = texel % 2 == 0 ? 0 : 2;
  return c == bright ? 0.3f + 0.1f * static_cast<float>(view) + 0.2f * static_cast<float>(light) : 0.02f;
}

Result<void> provideView(int view, std::span<float> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int light = static_cast<int>(i / (kSize * kSize * 3));
    out[i] = madeUpValue(view, light, i / 3 % (kSize * kSize), i % 3);
  }
  return {};
}

TEST(BtfWriter, ReadsBackLikeAMeasurement) {
  const fs::path zip = test::testFolder() / "stripes.zip";
  requireDone(writeBtfZip(zip, description(), provideView));
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(zip));
  const BtfDescription& d = source->description();
  EXPECT_EQ(d.width, kSize);
  EXPECT_EQ(d.height, kSize);
  EXPECT_EQ(d.encoding, Encoding::Gamma22);
  EXPECT_TRUE(d.cosineInData);
  EXPECT_EQ(d.views, description().views);
  EXPECT_EQ(d.lights, description().lights);
  const SampleRows rows = test::allRows(*source);
  for (std::size_t pair = 0; pair < 6; ++pair)
    for (std::size_t texel = 0; texel < d.texels(); ++texel) {
      const int x = static_cast<int>(texel) % kSize;
      const int y = static_cast<int>(texel) / kSize;
      const glm::vec3 rgb = test::linearSample(rows, x, y, pair);
      for (std::size_t c = 0; c < 3; ++c) {
        const float written = madeUpValue(static_cast<int>(pair / 2), static_cast<int>(pair % 2), texel, c);
        ASSERT_NEAR(encode(Encoding::Gamma22, rgb[static_cast<int>(c)]), encode(Encoding::Gamma22, written),
                    0.03f);
      }
    }
  EXPECT_THAT(test::namesIn(zip.parent_path()), ElementsAre("stripes.zip"));
}

TEST(BtfWriter, NamesImagesAsUbo2003Does) {
  const fs::path zip = test::testFolder() / "stripes.zip";
  requireDone(writeBtfZip(zip, description(), provideView));
  zip_t* archive = zip_open(zip.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr);
  ASSERT_NE(archive, nullptr);
  std::vector<std::string> names;
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(zip_get_num_entries(archive, 0)); ++i) {
    names.emplace_back(zip_get_name(archive, i, 0));
    zip_stat_t stat;
    ASSERT_EQ(zip_stat_index(archive, i, 0, &stat), 0);
    EXPECT_EQ(stat.comp_method, ZIP_CM_STORE);
  }
  zip_discard(archive);
  EXPECT_THAT(names,
              ElementsAre("UBO2003/STRIPES8/tv000_pv000/00000 tl000 pl000 tv000 pv000.jpg",
                          "UBO2003/STRIPES8/tv000_pv000/00001 tl075 pl345 tv000 pv000.jpg",
                          "UBO2003/STRIPES8/tv015_pv060/00000 tl000 pl000 tv015 pv060.jpg",
                          "UBO2003/STRIPES8/tv015_pv060/00001 tl075 pl345 tv015 pv060.jpg",
                          "UBO2003/STRIPES8/tv037.500_pv352.500/00000 tl000 pl000 tv037.500 pv352.500.jpg",
                          "UBO2003/STRIPES8/tv037.500_pv352.500/00001 tl075 pl345 tv037.500 pv352.500.jpg"));
}

TEST(BtfWriter, ClampsWhatTheLayoutCannotHold) {
  const fs::path zip = test::testFolder() / "extremes.zip";
  const auto extremes = [](int, std::span<float> out) -> Result<void> {
    const std::size_t half =
        out.size() / 2;  // the first light is too bright, the second negative or no number
    for (std::size_t i = 0; i < half; ++i) out[i] = 7.0f;
    for (std::size_t i = half; i < out.size(); ++i) out[i] = i % 2 ? -1.0f : std::nanf("");
    return {};
  };
  requireDone(writeBtfZip(zip, description(), extremes));
  const std::unique_ptr<BtfSource> source = valueOf(openBtf(zip));
  const SampleRows rows = test::allRows(*source);
  EXPECT_EQ(test::linearSample(rows, 0, 0, 0), glm::vec3(1.0f));
  EXPECT_EQ(test::linearSample(rows, kSize - 1, kSize - 1, 1), glm::vec3(0.0f));
}

TEST(BtfWriter, WritesEqualBytesForEqualInput) {
  const fs::path folder = test::testFolder();
  requireDone(writeBtfZip(folder / "a.zip", description(), provideView));
  requireDone(writeBtfZip(folder / "b.zip", description(), provideView));
  EXPECT_EQ(test::bytesOf(folder / "a.zip"), test::bytesOf(folder / "b.zip"));
}

TEST(BtfWriter, LeavesNothingBehindWhenAViewFails) {
  const fs::path folder = test::testFolder();
  const auto failing = [](int view, std::span<float> out) -> Result<void> {
    if (view == 1) return fail("the mesh has a hole");
    return provideView(view, out);
  };
  const Result<void> result = writeBtfZip(folder / "broken.zip", description(), failing);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message(), "the mesh has a hole");
  EXPECT_THAT(test::namesIn(folder), IsEmpty());
}

TEST(BtfWriter, RefusesAFolderThatIsNotThere) {
  const Result<void> result =
      writeBtfZip(test::testFolder() / "missing" / "stripes.zip", description(), provideView);
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message(), HasSubstr("the folder of the output does not exist"));
}

}  // namespace
}  // namespace weft
