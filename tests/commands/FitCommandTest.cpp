#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ClothZip.h"
#include "ProgramRun.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/FileLock.h"
#include "weft/fitter/FieldFit.h"
#include "weft/io/ImageFile.h"

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

std::string contentsOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

TEST(FitCommand, FitsAMeasurementThatInfoThenDescribes) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  for (const std::string model : {"rfp", "rfnl", "bump"}) {
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
    EXPECT_LT(fit.at("epsilon").at("stored").at("luminance").at("avg"), model == "bump" ? 0.05 : 0.01);
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

TEST(FitCommand, TakesTheModelThatSuitsTheLightsOfOneView) {
  const fs::path folder = test::testFolder();
  const fs::path field = folder / "coin.rf.exr";
  std::string list = "9\n";
  for (int i = 0; i < 9; ++i) {
    const std::string name = std::to_string(i) + ".png";
    test::requireDone(
        writePng(folder / name, test::imageOf(3, 2, [&](int, int, int) { return 40 + 20 * i; })));
    list += fmt::format("{} {} {} {}\n", name, 0.4 * (i % 3 - 1), 0.4 * (i / 3 - 1), 0.7);
  }
  std::ofstream(folder / "coin.lp") << list;
  const auto modelOf = [&](std::vector<std::string> options) {
    options.insert(options.end(), {folder / "coin.lp", "-o", field, "--json", folder / "fit.json"});
    const ProgramRun run = runProgram("weft-fit", options);
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.out.starts_with("model "), options.front() != "--model") << run.out;
    return json::parse(std::ifstream(folder / "fit.json")).at("model").get<std::string>();
  };
  EXPECT_EQ(modelOf({"--quiet"}), "rfp");
  EXPECT_EQ(modelOf({"--color", "rgb"}), "rfp");
  EXPECT_EQ(modelOf({"--lobes", "1"}), "rfnl");
  EXPECT_EQ(modelOf({"--model", "ptm"}), "ptm");
  EXPECT_THAT(runProgram("weft-fit", {clothZip(folder), "-o", field}).out,
              testing::StartsWith("model loom, because of 81 views (--model takes another)\n"
                                  "no lobe of gloss: "));
  const ProgramRun glossy = runProgram("weft-fit", {clothZip(folder), "-o", field, "--gloss", "on"});
  ASSERT_EQ(glossy.exitCode, 0) << glossy.err;
  const ProgramRun info = runProgram("weft-info", {field});
  EXPECT_THAT(info.out, HasSubstr("loom_gloss")) << info.err;
}

TEST(FitCommand, EqualInputGivesEqualBytesOnAnyNumberOfThreads) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const auto bytesWith = [&](const std::string& threads) {
    const fs::path field = folder / (threads + ".rf.exr");
    EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field, "--threads", threads, "--quiet"}).exitCode, 0);
    return contentsOf(field);
  };
  const std::string one = bytesWith("1");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == bytesWith("2"));
}

TEST(FitCommand, SeveralProcessesWriteTheSameBytes) {
#ifdef WEFT_MPIRUN
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  // OpenMPI leaks from modules that it has unloaded, which no suppression can name: leaks are told
  // but do not count here.
  setenv("LSAN_OPTIONS", "exitcode=0", 1);
  const fs::path alone = folder / "alone.rf.exr";
  const fs::path together = folder / "together.rf.exr";
  ASSERT_EQ(runProgram("weft-fit", {zip, "-o", alone}).exitCode, 0);
  const std::string program = test::programFolder() / "weft-fit";
  const ProgramRun run =
      runProgram(WEFT_MPIRUN, {"--oversubscribe", "-n", "3", program, zip, "-o", together});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("stored luminance"));
  EXPECT_TRUE(contentsOf(alone) == contentsOf(together));
  EXPECT_FALSE(fs::exists(together.string() + ".parts"));
  EXPECT_NE(
      runProgram(WEFT_MPIRUN, {"--oversubscribe", "-n", "3", program, folder / "absent.zip", "-o", together})
          .exitCode,
      0);
#else
  GTEST_SKIP() << "built without MPI";
#endif
}

// Killed between two rows: what is finished stays, and is gone once the file is there.
TEST(FitCommand, AFitThatWasKilledGoesOn) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path whole = folder / "whole.rf.exr";
  const fs::path resumed = folder / "resumed.rf.exr";
  const fs::path parts = resumed.string() + ".parts";
  ASSERT_EQ(runProgram("weft-fit", {zip, "-o", whole}).exitCode, 0);
  for (const char* seconds : {"0.02", "0.1", "0.3"})
    runProgram("/usr/bin/timeout", {"--signal=KILL", seconds, test::programFolder() / "weft-fit", zip, "-o",
                                    resumed, "--resume", "--quiet"});
  ASSERT_EQ(runProgram("weft-fit", {zip, "-o", resumed, "--resume"}).exitCode, 0);
  EXPECT_TRUE(contentsOf(whole) == contentsOf(resumed));
  EXPECT_FALSE(fs::exists(parts));

  fs::create_directories(parts);
  std::ofstream(parts / "000000-000000.rows") << "nonsense";
  expectRefused(runProgram("weft-fit", {zip, "-o", resumed, "--resume"}), 2, "000000-000000.rows");
  EXPECT_EQ(runProgram("weft-fit", {zip, "-o", resumed}).exitCode, 0) << "starts over";
  EXPECT_FALSE(fs::exists(parts));
}

// The measurement is another one under the same name.
TEST(FitCommand, ResumesNoOtherMeasurement) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path field = folder / "cloth.rf.exr";
  const auto source = test::valueOf(openBtf(zip));
  FitOptions options;
  options.model.name = "loom";
  options.partsFolder = field.string() + ".parts";
  options.secondsBetweenSaves = 0.0;
  test::requireDone(test::valueOf(FieldFit::create(*source, options)).fitRows(0, 2, {}));
  EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field, "--resume"}).exitCode, 0);

  test::requireDone(test::valueOf(FieldFit::create(*source, options)).fitRows(0, 2, {}));
  clothZip(folder, 0.5f);
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--resume"}), 2, "another fit");
}

TEST(FitCommand, OfTwoFitsWithOneOutputTheSecondSaysSo) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path field = folder / "cloth.rf.exr";
  const fs::path parts = field.string() + ".parts";
  fs::create_directories(parts);
  std::ofstream(parts / "0-000000-000000.rows") << "of the first";
  {
    const auto first = test::valueOf(FileLock::tryAcquire(parts / "lock"));
    ASSERT_TRUE(first);
    expectRefused(runProgram("weft-fit", {zip, "-o", field}), 2, "another fit with this output is running");
    EXPECT_FALSE(fs::exists(field));
    EXPECT_TRUE(fs::exists(parts / "0-000000-000000.rows"));
  }
  EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field}).exitCode, 0);
  EXPECT_FALSE(fs::exists(parts));
}

TEST(FitCommand, LeavesWhatItFindsInItsPartsFolder) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path field = folder / "cloth.rf.exr";
  const fs::path parts = field.string() + ".parts";
  std::ofstream(parts) << "mine";
  expectRefused(runProgram("weft-fit", {zip, "-o", field}), 2, parts.string());
  EXPECT_EQ(contentsOf(parts), "mine");
  fs::remove(parts);
  fs::create_directories(parts / "mine");
  EXPECT_EQ(runProgram("weft-fit", {zip, "-o", field}).exitCode, 0);
  EXPECT_TRUE(fs::exists(parts / "mine"));
}

TEST(FitCommand, ReportsHeldOutPairs) {
  const fs::path folder = test::testFolder();
  const fs::path zip = clothZip(folder);
  const fs::path field = folder / "cloth.rf.exr";
  const ProgramRun run = runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--hold-out", "8",
                                                 "--hold-out-views", "10", "--json", "-"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const json fit = json::parse(run.out);
  const json& heldOut = fit.at("held_out");
  EXPECT_GT(heldOut.at("epsilon").at("stored").at("luminance").at("avg"), 0.0);
  EXPECT_TRUE(heldOut.at("psnr").at("linear").at("rgb").is_number());
  EXPECT_EQ(json::parse(runProgram("weft-info", {field, "--json", "-"}).out).at("fit").at("held_out"),
            heldOut);
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
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--lobes", "2"}), 1,
                "the model 'rfp' has no option 'lobes' (its options are color)");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--model", "laf", "--rho-d", "per-view"}), 1,
                "the model 'laf' has no option 'rho_d' (its options are lobes, color)");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--components", "10"}), 1, "multiple of 4");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--model", "rfp", "--gloss", "on"}), 1,
                "--gloss is for the model loom, not for rfp");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--components", "400"}), 1, "4 to 128");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--lobes", "2.5"}), 1,
                "'lobes' of the model 'rfnl' cannot be 2.5 (1 to 4)");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--crop", "1", "2"}), 1, "crop");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--hold-out", "1"}), 1, "hold-out");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--space", "stored", "--cosine", "out"}), 1,
                "stored");
  expectRefused(runProgram("weft-fit", {zip, "-o", field, "--model", "bump", "--cosine", "out"}), 1, "n.l");
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
