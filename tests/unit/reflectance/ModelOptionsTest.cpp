#include "weft/reflectance/ModelOptions.h"

#include <gmock/gmock.h>

#include "TestSupport.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {
namespace {

using test::valueOf;
using testing::HasSubstr;

std::string refusalOf(const ModelDescription& description) {
  const auto model = ModelRegistry::builtin().create(description);
  return model ? "made" : model.error().message();
}

TEST(ModelOptions, ThoseThatAreLeftOutHaveTheirStandard) {
  const auto model = valueOf(ModelRegistry::builtin().create({"rfnl", {{"rho_d", "per-view"}}}));
  const ModelDescription complete{"rfnl", {{"lobes", 2}, {"rho_d", "per-view"}, {"color", "luminance"}}};
  EXPECT_EQ(model->description(), complete);
}

TEST(ModelOptions, ThoseThatAModelDoesNotHaveAreRefusedWithThoseThatItHas) {
  EXPECT_EQ(refusalOf({"rfp", {{"lobes", 2}}}),
            "the model 'rfp' has no option 'lobes' (its options are color)");
  EXPECT_EQ(refusalOf({"bump", {{"color", "rgb"}}}),
            "the model 'bump' has no option 'color' (it has no options)");
}

TEST(ModelOptions, ValuesOutOfRangeAreRefusedWithTheRange) {
  EXPECT_EQ(refusalOf({"rfnl", {{"lobes", 9}}}), "'lobes' of the model 'rfnl' cannot be 9 (1 to 4)");
  EXPECT_EQ(refusalOf({"rfnl", {{"lobes", "two"}}}), "'lobes' of the model 'rfnl' cannot be two (1 to 4)");
  EXPECT_EQ(refusalOf({"rfnl", {{"rho_d", 1}}}),
            "'rho_d' of the model 'rfnl' cannot be 1 (shared, per-view)");
  EXPECT_EQ(refusalOf({"laf", {{"color", "cmyk"}}}),
            "'color' of the model 'laf' cannot be cmyk (luminance, rgb)");
}

TEST(ModelOptions, TextsMeanNumbersOnlyWhereTheOptionIsOne) {
  const ModelOption lobes = ModelOption::number("lobes", "how many", 2, 1, 4);
  EXPECT_EQ(lobes.valueFrom("3"), OptionValue(3));
  for (const char* text : {"3.5", "3 ", "", "three", "99999999999"})
    EXPECT_FALSE(lobes.accepts(lobes.valueFrom(text))) << text;
  EXPECT_EQ(ModelOption::choice("size", "how large", {{"3", ""}}).valueFrom("3"), OptionValue("3"));
}

TEST(ModelOptions, LabelsSayWhatIsNotUsual) {
  const auto labelOf = [](const ModelDescription& description) {
    return valueOf(ModelRegistry::builtin().create(description))->options().label();
  };
  EXPECT_EQ(labelOf({"rfp"}), "rfp");
  EXPECT_EQ(labelOf({"laf", {{"lobes", 1}}}), "laf, 1 lobe");
  EXPECT_EQ(labelOf({"rfnl", {{"rho_d", "per-view"}, {"color", "rgb"}}}),
            "rfnl, 2 lobes, rho_d per view, RGB");
}

TEST(ModelRegistry, EveryTypeSaysWhatItIsAndMakesItsStandard) {
  const ModelRegistry registry = ModelRegistry::builtin();
  EXPECT_EQ(registry.types().size(), 11u);
  for (const ModelType& type : registry.types()) {
    EXPECT_THAT(type.purpose, testing::EndsWith(".")) << type.name;
    EXPECT_EQ(valueOf(registry.create({type.name}))->description().name, type.name);
    for (const ModelOption& option : type.options) {
      EXPECT_TRUE(option.accepts(option.standard)) << type.name << " " << option.name;
      EXPECT_NE(option.help, "");
    }
  }
}

TEST(ModelRegistry, ALaterTypeReplacesOneOfTheSameName) {
  ModelRegistry registry = ModelRegistry::builtin();
  ModelType type = valueOf(registry.find("rfp"));
  type.purpose = "Another.";
  registry.add(type);
  EXPECT_EQ(registry.types().size(), ModelRegistry::builtin().types().size());
  EXPECT_EQ(valueOf(registry.find("rfp")).purpose, "Another.");
}

}  // namespace
}  // namespace weft
