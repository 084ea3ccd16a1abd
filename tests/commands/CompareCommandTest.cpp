#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ClothZip.h"
#include "HtmlPage.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::clothZip;
using test::ProgramRun;
using test::runProgram;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(CompareCommand, FitsEveryModelAsWeftFitDoes) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder), out = folder / "cloth";
  const ProgramRun run =
      runProgram("weft-compare", {zip, "--models", "rfp,rfnl", "--hold-out", "3", "-o", out});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("rfnl, 2 lobes, rho_d per view"));

  const json report = json::parse(std::ifstream(out / "compare.json"));
  std::vector<std::string> labels;
  for (const json& model : report.at("models")) {
    labels.push_back(model.at("label"));
    const fs::path again = folder / "again.rf.exr";
    std::vector<std::string> fitting{
        zip, "-o", again, "--model", model.at("name"), "--hold-out", "3", "--json", folder / "again.json"};
    if (model.contains("rho_d")) fitting.insert(fitting.end(), {"--rho-d", model.at("rho_d")});
    ASSERT_EQ(runProgram("weft-fit", fitting).exitCode, 0);
    const json fit = json::parse(std::ifstream(folder / "again.json"));
    for (const char* key : {"epsilon", "rmse", "psnr", "held_out", "bytes", "color"})
      EXPECT_EQ(model.at(key), fit.at(key)) << key;
    for (const char* option : {"lobes", "rho_d"})
      EXPECT_EQ(model.value(option, json()), fit.value(option, json())) << option;
    EXPECT_TRUE(test::readText(out / model.at("file")) == test::readText(again));
    // The models fit this cloth all but exactly, on a rendered cloth, too.
    EXPECT_GT(model.at("picture_difference"), 0.0);
    EXPECT_LT(model.at("picture_difference"), 0.01);
  }
  EXPECT_THAT(labels, ElementsAre("rfp", "rfnl, 2 lobes", "rfnl, 2 lobes, rho_d per view"));

  std::vector<int> polarAngles;
  for (const json& view : report.at("single_views")) {
    polarAngles.push_back(static_cast<int>(std::lround(view.at("view").at(0).get<double>())));
    for (const char* lights : {"measured_lights", "lights_between"})
      EXPECT_LT(view.at(lights).at("epsilon").at("linear").at("luminance").at("avg"), 0.04);
  }
  EXPECT_THAT(polarAngles, ElementsAre(0, 0, 30, 30, 45, 45));

  const std::string html = test::pageWithoutPictures(out / "index.html");
  for (const char* part : {"3 x 2 texels", "held out", "Costs", "One texel", "On a cloth", "Single views",
                           "knitted wool", "data:image/png;base64,", "</svg>", "</html>"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* outside : {"http", "<script", "file:", ">nan", ">inf"})
    EXPECT_THAT(html, Not(HasSubstr(outside)));
}

TEST(CompareCommand, BadUsageAndInputLeaveNothing) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder), out = folder / "out";
  EXPECT_EQ(runProgram("weft-compare", {zip}).exitCode, 1);
  EXPECT_EQ(runProgram("weft-compare", {zip, "--models", "rfp,magic", "-o", out}).exitCode, 1);
  EXPECT_EQ(runProgram("weft-compare", {folder / "none.zip", "-o", out}).exitCode, 2);
  EXPECT_EQ(
      runProgram("weft-compare", {zip, "--models", "rfp", "--crop", "2", "0", "2", "2", "-o", out}).exitCode,
      2);
  EXPECT_FALSE(fs::exists(out));
  const ProgramRun run = runProgram("weft-compare", {zip, "--models", "rfp", "-o", folder / "no" / "folder"});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(run.err, HasSubstr("make the folder"));
}

}  // namespace
}  // namespace weft
