#include <gmock/gmock.h>

#include "TestSupport.h"
#include "weft/baking/BtfBaker.h"
#include "weft/baking/SurfaceMaps.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

using testing::HasSubstr;
using Color = std::array<std::uint8_t, 3>;

class SurfaceMapsFromPictures : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, int width, int height,
                              const std::function<Color(int x, int y)>& color) {
    Image image(width, height, 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) std::ranges::copy(color(x, y), image.pixel(x, y));
    test::requireDone(writePng(folder / name, image));
    return folder / name;
  }

  // Hills that repeat, 8 x 4 pixels.
  std::filesystem::path hills() {
    return write("height.png", 8, 4, [](int x, int y) {
      const auto value = static_cast<std::uint8_t>(40 * std::min(x, 8 - x) + 20 * std::min(y, 4 - y));
      return Color{value, value, value};
    });
  }

  HeightField surface(const SurfaceMaps& maps) { return test::valueOf(readSurfaceMaps(maps, warnings)); }
  std::string reason(const SurfaceMaps& maps) {
    const auto read = readSurfaceMaps(maps, warnings);
    return read ? "" : read.error().message();
  }

  std::filesystem::path folder = test::testFolder();
  std::vector<std::string> warnings;
};

TEST_F(SurfaceMapsFromPictures, ThePicturesBecomeHeightsAlbedoAndRoughness) {
  const auto albedo = write("albedo.png", 8, 4, [](int x, int) {
    return x == 2 ? Color{255, 188, 0} : Color{};
  });
  const auto rough = write("rough.png", 8, 4, [](int, int y) {
    return y == 1 ? Color{128, 128, 128} : Color{255, 255, 255};
  });
  const HeightField field = surface({hills(), 0.5f, albedo, rough});
  EXPECT_EQ(field.columns, 8);
  EXPECT_EQ(field.rows, 4);
  EXPECT_FLOAT_EQ(field.spacing, 1.0f / 8.0f);
  EXPECT_NEAR(field.at(3, 2).height - field.at(0, 0).height, 0.5f * 160.0f / 255.0f, 1e-6f);
  EXPECT_NEAR(field.highest() + field.lowest(), 0.0f, 1e-6f) << "these hills have their mean in the middle";
  EXPECT_FLOAT_EQ(field.at(2, 0).albedo.r, 0.96f) << "4 % are mirrored";
  EXPECT_NEAR(field.at(2, 0).albedo.g, 0.96f * 0.5029f, 1e-4f) << "sRGB 188 is half of the light";
  EXPECT_FLOAT_EQ(field.at(2, 0).albedo.b, 0.0f);
  EXPECT_FLOAT_EQ(field.at(5, 0).roughness, 1.0f);
  EXPECT_NEAR(field.at(5, 1).roughness, 0.2520f, 1e-4f) << "GGX's alpha is the square of glTF's roughness";
  EXPECT_EQ(warnings, std::vector<std::string>());
  EXPECT_TRUE(BtfBaker::create(field, {}).has_value());
}

TEST_F(SurfaceMapsFromPictures, HeightsAloneAreGreyAndMatt) {
  const HeightField field = surface({hills(), 0.1f, {}, {}});
  EXPECT_EQ(field.at(1, 1).albedo, glm::vec3(0.5f));
  EXPECT_EQ(field.at(1, 1).specular, 0.0f);
}

TEST_F(SurfaceMapsFromPictures, WhatAMapCannotMeanIsTold) {
  const auto ramp = write("ramp.png", 8, 4, [](int x, int) {
    const auto value = static_cast<std::uint8_t>(30 * x);
    return Color{value, 0, value};
  });
  const auto smooth = write("smooth.png", 8, 4, [](int, int) { return Color{10, 10, 10}; });
  surface({ramp, 0.1f, {}, smooth});
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("not grey"), HasSubstr("smoother than 0.22"),
                                             HasSubstr("borders do not continue")));
}

TEST_F(SurfaceMapsFromPictures, OtherSizesAndMissingPicturesAreRefused) {
  const auto small = write("small.png", 4, 4, [](int, int) { return Color{}; });
  EXPECT_THAT(reason({hills(), 0.1f, small, {}}), testing::AllOf(HasSubstr("small.png"), HasSubstr("4 x 4")));
  EXPECT_THAT(reason({hills(), 0.1f, {}, folder / "none.png"}), HasSubstr("none.png"));
}

}  // namespace
}  // namespace weft
