#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ClothZip.h"
#include "HtmlPage.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::clothZip;
using test::ProgramRun;
using test::runProgram;
using test::valueOf;
using testing::HasSubstr;
using testing::Not;

TEST(EvalCommand, FindsTheErrorsThatTheFitReported) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder), field = folder / "cloth.rf.exr";
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--hold-out", "3", "--hold-out-views", "4"}, {"--space", "stored"}}) {
    std::vector<std::string> fit{zip, "-o", field, "--model", "rfp", "--json", folder / "fit.json"};
    fit.insert(fit.end(), more.begin(), more.end());
    ASSERT_EQ(runProgram("weft-fit", fit).exitCode, 0);
    const ProgramRun run = runProgram("weft-eval", {field, "--against", zip, "--json", folder / "eval.json"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("rfp, 3 x 2 texels"));
    const json fitted = json::parse(std::ifstream(folder / "fit.json"));
    const json evaluated = json::parse(std::ifstream(folder / "eval.json"));
    for (const char* key : {"epsilon", "rmse", "psnr", "psnr_peak", "held_out", "texels", "bytes", "model"})
      EXPECT_EQ(evaluated.at(key), fitted.at(key)) << key;
    EXPECT_EQ(evaluated.at("held_out").is_null(), more.size() < 4);
  }
}

TEST(EvalCommand, ReportsStandAlone) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder), field = folder / "cloth.rf.exr";
  ASSERT_EQ(
      runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--report", folder / "fit.html"}).exitCode,
      0);
  ASSERT_EQ(runProgram("weft-eval", {field, "--against", zip, "--report", folder / "eval.html"}).exitCode, 0);
  for (const char* name : {"fit.html", "eval.html"}) {
    const std::string html = test::pageWithoutPictures(folder / name);
    EXPECT_THAT(html, HasSubstr("stored luminance"));
    EXPECT_THAT(html, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(html, Not(HasSubstr("http")));
    EXPECT_THAT(html, HasSubstr("</html>"));
  }
}

TEST(EvalCommand, WritesWhatTheFieldGives) {
  const fs::path folder = test::testFolder();
  const fs::path file = folder / "cloth.rf.exr", picture = folder / "picture.exr";
  ASSERT_EQ(runProgram("weft-fit", {clothZip(folder), "-o", file, "--model", "rfp"}).exitCode, 0);
  const ProgramRun run = runProgram("weft-eval", {file, "--image", "37", "20", "50", "200", "-o", picture});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const ReflectanceField field = valueOf(readReflectanceField(file, ModelRegistry::builtin()));
  const FloatImage image = valueOf(readExr(picture));
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      const glm::vec3 value =
          field.evaluate(x, y, directionFromDegrees(50, 200), directionFromDegrees(37, 20));
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(image.at(x, y, *image.channelIndex(std::string(1, "RGB"[channel]))), value[channel],
                    1e-6f);
    }
}

TEST(EvalCommand, CropsNameTheTexelsThatWereFitted) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder), field = folder / "cloth.rf.exr";
  ASSERT_EQ(runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--crop", "1", "0", "1", "2",
                                    "--json", folder / "fit.json"})
                .exitCode,
            0);
  const ProgramRun whole = runProgram("weft-eval", {field, "--against", zip});
  EXPECT_EQ(whole.exitCode, 2);
  EXPECT_THAT(whole.err, HasSubstr("--crop"));
  ASSERT_EQ(runProgram("weft-eval", {field, "--against", zip, "--crop", "1", "0", "1", "2", "--json",
                                     folder / "eval.json"})
                .exitCode,
            0);
  EXPECT_EQ(json::parse(std::ifstream(folder / "eval.json")).at("epsilon"),
            json::parse(std::ifstream(folder / "fit.json")).at("epsilon"));
}

// The same sizes and directions: only the errors tell.
TEST(EvalCommand, ErrorsAgainstAnotherMeasurementAreSaid) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder), field = folder / "cloth.rf.exr", tiles = folder / "tiles.zip";
  ASSERT_EQ(runProgram("weft-fit", {zip, "-o", field, "--model", "rfp"}).exitCode, 0);
  ASSERT_EQ(
      runProgram("weft-bake", {"-o", tiles, "--pattern", "tiles", "--size", "3", "--samples", "1"}).exitCode,
      0);
  const std::vector<std::string> crop{"--crop", "0", "0", "3", "2", "--quiet"};
  const auto evaluate = [&](const fs::path& measurement) {
    std::vector<std::string> arguments{
        field, "--against", measurement, "--report", folder / "eval.html", "--json", folder / "eval.json"};
    arguments.insert(arguments.end(), crop.begin(), crop.end());
    return runProgram("weft-eval", arguments);
  };
  const ProgramRun other = evaluate(tiles);
  EXPECT_EQ(other.exitCode, 0);
  EXPECT_THAT(other.err, HasSubstr("tiles is not what was fitted, which was cloth: eps"));
  EXPECT_EQ(json::parse(std::ifstream(folder / "eval.json")).at("warnings").size(), 1);
  EXPECT_THAT(test::pageWithoutPictures(folder / "eval.html"), HasSubstr("is not what was fitted"));

  fs::rename(zip, folder / "renamed.zip");
  EXPECT_EQ(evaluate(folder / "renamed.zip").err, "") << "the same under another name";
  EXPECT_TRUE(json::parse(std::ifstream(folder / "eval.json")).at("warnings").empty());
  fs::rename(tiles, zip);
  EXPECT_THAT(evaluate(zip).err, HasSubstr("cloth is not what was fitted, or not those texels"));
}

TEST(EvalCommand, BadUsageAndInputAreRefused) {
  const fs::path folder = test::testFolder();
  const fs::path field = folder / "cloth.rf.exr";
  ASSERT_EQ(runProgram("weft-fit", {clothZip(folder), "-o", field, "--model", "rfp"}).exitCode, 0);
  EXPECT_EQ(runProgram("weft-eval", {field}).exitCode, 1);
  EXPECT_EQ(runProgram("weft-eval", {field, "--image", "1", "2", "3", "4"}).exitCode, 1);
  EXPECT_EQ(runProgram("weft-eval", {field, "--image", "1", "2", "-o", folder / "a.exr"}).exitCode, 1);
  EXPECT_EQ(runProgram("weft-eval", {field, "--report", folder / "a.html"}).exitCode, 1);
  const ProgramRun png =
      runProgram("weft-eval", {field, "--image", "1", "2", "3", "4", "-o", folder / "a.png"});
  EXPECT_EQ(png.exitCode, 1);
  EXPECT_THAT(png.err, HasSubstr("-o takes a .exr"));
  EXPECT_FALSE(fs::exists(folder / "a.png"));
  EXPECT_EQ(runProgram("weft-eval", {folder / "none.rf.exr", "--against", folder / "cloth.zip"}).exitCode, 2);
  EXPECT_EQ(runProgram("weft-eval", {field, "--against", folder / "none.zip"}).exitCode, 2);
}

}  // namespace
}  // namespace weft
