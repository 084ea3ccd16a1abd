#include "weft/reflectance/LodModel.h"

#include <gmock/gmock.h>

#include "SomeModels.h"
#include "TestSupport.h"
#include "weft/reflectance/LevelSum.h"

namespace weft {
namespace {

using test::unevenField;
using test::valueOf;

TEST(LevelSum, ALevelCountsFromItsOwnLevelOfDetailOn) {
  for (const auto& [distance, detail] : {std::pair(0.5f, 0.0f), {1.0f, 0.0f}, {2.0f, 1.0f}, {4.0f, 2.0f}})
    EXPECT_EQ(detailAtDistance(distance, 5), detail);
  EXPECT_EQ(detailAtDistance(1e9f, 5), 4.0f);
  EXPECT_EQ(shareOfLevel(0, 0.0f), 1.0f);
  EXPECT_EQ(shareOfLevel(0, 0.75f), 0.25f);
  EXPECT_EQ(shareOfLevel(1, 0.75f), 1.0f);
  EXPECT_EQ(shareOfLevel(0, 2.0f), 0.0f);
  EXPECT_EQ(shareOfLevel(4, 2.0f), 1.0f);
}

TEST(LodModel, YCbCrIsTurnedBack) {
  const glm::vec3 rgb(0.7f, 0.2f, 0.4f), back = rgbFromYCbCr(yCbCrFromRgb(rgb));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-6f);
  EXPECT_NEAR(yCbCrFromRgb({0, 0, 1}).y, 0.5f, 1e-6f);
  EXPECT_NEAR(yCbCrFromRgb({1, 0, 0}).z, 0.5f, 1e-6f);
}

TEST(LodModel, NumbersThatCannotBeDrawnAreRefused) {
  const ModelRegistry registry = ModelRegistry::builtin();
  EXPECT_THAT(registry.create({"lod", {{"components", 6}}}).error().message(),
              testing::HasSubstr("lod cannot have 6 components"));
  EXPECT_THAT(registry.create({"lod", {{"chroma", 3}}}).error().message(),
              testing::HasSubstr("lod cannot have 3 components of chroma"));
}

std::string refusalOf(const ReflectanceField& field, FieldTables tables) {
  const auto model = valueOf(ModelRegistry::builtin().create(field.model().description()));
  const auto made = ReflectanceField::create(model, field.description(), field.levels(), std::move(tables));
  return made ? "made" : made.error().message();
}

TEST(LodModel, TablesThatDoNotFitTheFieldAreRefused) {
  const ReflectanceField field = unevenField({.name = "lod"}, 4, 4);
  const auto withLevels = [&](float levels) {
    FieldTables tables = field.tables();
    tables.at("mean").at(0, 0, LodModel::Levels) = levels;
    return refusalOf(field, std::move(tables));
  };
  EXPECT_EQ(withLevels(1.0f), "made");
  EXPECT_THAT(withLevels(0.0f), testing::HasSubstr("a pyramid of 0 levels"));
  EXPECT_THAT(withLevels(1.5f), testing::HasSubstr("a pyramid of 1.5 levels"));
  EXPECT_THAT(withLevels(2.0f), testing::HasSubstr("maps of 2 levels of 20 x 5 texels"));
  FieldTables fewer = field.tables();
  fewer.at("eigen_brdfs") = FloatImage(15, 5, fewer.at("eigen_brdfs").channels());
  EXPECT_THAT(refusalOf(field, fewer), testing::HasSubstr("polynomials of 4 and 4 maps, of 3 views"));
  for (const char* name : {"light_polynomials", "mean_polynomials"})
    fewer.at(name) = FloatImage(LodModel::kTerms, 3, fewer.at(name).channels());
  EXPECT_THAT(refusalOf(field, fewer), testing::HasSubstr("4 views are described, the tables are of"));
}

}  // namespace
}  // namespace weft
