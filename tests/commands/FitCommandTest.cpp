#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ClothZip.h"
#include "ProgramRun.h"
#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::clothZip;
using test::ProgramRun;
using test::runProgram;
using testing::AllOf;
using testing::HasSubstr;

void expectRefused(const ProgramRun& run, int exitCode, const std::string& message) {
  EXPECT_EQ(run.exitCode, exitCode) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_THAT(run.err, HasSubstr(message));
}

TEST(FitCommand, FitsAMeasurementThatInfoThenDescribes) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  for (const std::string model : {"rfp", "rfnl"}) {
    const fs::path field = folder / (model + ".rf.exr");
    const fs::path report = folder / (model + ".json");
    const ProgramRun run = runProgram("weft-fit", {zip, "-o", field, "--model", model, "--json", report});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, AllOf(HasSubstr("stored luminance"), HasSubstr("81 views x 81 lights")));

    const json fit = json::parse(std::ifstream(report));
    EXPECT_EQ(fit.at("model"), model);
    EXPECT_EQ(fit.at("texels"), 6);
    EXPECT_EQ(fit.at("views"), 81);
    EXPECT_EQ(fit.at("lights"), 81);
    EXPECT_LT(fit.at("epsilon").at("stored").at("luminance").at("avg"), 0.01);
    for (const char* key : {"rmse", "psnr"})
      for (const char* space : {"stored", "linear"})
        for (const char* measure : {"luminance", "rgb"})
          EXPECT_TRUE(fit.at(key).at(space).at(measure).is_number());
    EXPECT_EQ(fit.at("bytes").at("file"), fs::file_size(field));
    EXPECT_TRUE(fit.at("held_out").is_null());
    for (const char* key : {"read", "fit", "write"}) EXPECT_GE(fit.at("seconds").at(key), 0.0);
    EXPECT_GT(fit.at("peak_memory_bytes"), 1000000);

    const json info = json::parse(runProgram("weft-info", {field, "--json", "-"}).out);
    EXPECT_EQ(info.at("model").at("name"), model);
    EXPECT_EQ(info.at("fit").at("epsilon"), fit.at("epsilon"));
    EXPECT_EQ(info.at("bytes").at("gpu"), fit.at("bytes").at("gpu"));
  }
}

TEST(FitCommand, EqualInputGivesEqualBytesOnAnyNumberOfThreads) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const auto bytesWith = [&](const std::string& threads) {
    const fs::path field = folder / (threads + ".rf.exr");
    EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field, "--threads", threads, "--quiet"}).exitCode, 0);
    std::ifstream file(field, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string one = bytesWith("1");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == bytesWith("2"));
}

TEST(FitCommand, AnErrorAboveTheBoundEndsWithThree) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path field = folder / "cloth.rf.exr";
  EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--max-error", "1e-6"}).exitCode, 3);
  EXPECT_TRUE(fs::exists(field));
  EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--max-error", "0.5"}).exitCode, 0);
}

TEST(FitCommand, BadUsageEndsWithOne) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path field = folder / "cloth.rf.exr";
  expectRefused(runProgram("weft-fit", {zip}), 1, "-o");
  expectRefused(runProgram("weft-fit", {zip, "-o", folder / "cloth.exr"}), 1, ".rf.exr");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--model", "magic"}), 1, "magic");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--lobes", "0"}), 1, "lobes");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--crop", "1", "2"}), 1, "crop");
  EXPECT_FALSE(fs::exists(field));
}

TEST(FitCommand, BadInputEndsWithTwoAndLeavesNothing) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path output = folder / "output";
  fs::create_directories(output);
  fs::create_directories(folder / "empty");
  const fs::path truncated = folder / "truncated.zip";
  fs::copy_file(zip, truncated);
  fs::resize_file(truncated, fs::file_size(zip) / 2);
  std::ofstream(folder / "text.zip") << "this is no zip";

  for (const fs::path& input : {folder / "absent.zip", folder / "empty", truncated, folder / "text.zip"}) {
    const ProgramRun run = runProgram("weft-fit", {input, "-o", output / "cloth.rf.exr"});
    expectRefused(run, 2, input.filename());
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << run.err;
    EXPECT_TRUE(fs::is_empty(output)) << input;
  }
  expectRefused(runProgram("weft-fit", {zip, "-o", output / "cloth.rf.exr", "--crop", "2", "0", "2", "2"}), 2,
                "crop");
  expectRefused(
      runProgram("weft-fit", {zip, "-o", folder / "no" / "folder" / "cloth.rf.exr", "--model", "rfp"}), 2,
      "folder");
  EXPECT_TRUE(fs::is_empty(output));
}

}  // namespace
}  // namespace weft
