#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/measurement/BtfSource.h"

namespace weft::test {
namespace {

std::size_t filesIn(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(BakeCommand, WritesAZipThatReadsLikeAMeasuredOneOnAnyNumberOfThreads) {
  const std::filesystem::path folder = testFolder();
  const auto bake = [&](const std::string& name, const std::string& threads) {
    return runProgram("weft-bake",
                      {"-o", (folder / name).string(), "--pattern", "tiles", "--size", "8", "--samples", "2",
                       "--threads", threads, "--quiet", "--json", (folder / "bake.json").string()});
  };
  const ProgramRun run = bake("tiles.zip", "1");
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("8 x 8 texels"), std::string::npos) << "--quiet keeps the result";
  const auto btf = valueOf(openBtf(folder / "tiles.zip"));
  EXPECT_EQ(btf->description().width, 8);
  EXPECT_EQ(btf->description().height, 8);
  EXPECT_EQ(btf->description().views.size(), 81u);
  EXPECT_EQ(btf->description().lights.size(), 81u);

  const auto report = nlohmann::json::parse(contentOf(folder / "bake.json"));
  EXPECT_EQ(report["pattern"], "tiles");
  EXPECT_LE(report["scale"], 1.0);
  EXPECT_LE(report["clipped_share"], 0.001);
  EXPECT_EQ(report["bytes"]["file"], std::filesystem::file_size(folder / "tiles.zip"));

  ASSERT_EQ(bake("again.zip", "2").exitCode, 0);
  EXPECT_TRUE(contentOf(folder / "tiles.zip") == contentOf(folder / "again.zip"));
  EXPECT_EQ(filesIn(folder), 3u) << "nothing is left beside the outputs";
}

TEST(BakeCommand, BadOptionsEndWithOneAndNameWhatIsWrong) {
  const std::filesystem::path folder = testFolder();
  const std::string zip = (folder / "x.zip").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"-o", zip, "--pattern", "felt"}, "felt"},
      {{"-o", zip, "--pattern", "weave", "--size", "0"}, "--size"},
      {{"-o", zip, "--pattern", "weave", "--scale", "-1"}, "--scale"},
      {{"-o", zip, "--pattern", "weave", "--directions", "mine"}, "mine"},
      {{"-o", (folder / "x.btf").string(), "--pattern", "weave"}, "x.btf"},
      {{"-o", zip}, "--pattern and --height"},
      {{"-o", zip, "--pattern", "weave", "--height", "x.png"}, "--pattern and --height"},
      {{"-o", zip, "--pattern", "weave", "--albedo", "x.png"}, "--height"},
      {{"-o", zip, "--height", "x.png"}, "--depth"},
      {{"--pattern", "weave"}, "-o"}};
  for (const auto& [arguments, named] : cases) {
    const ProgramRun run = runProgram("weft-bake", arguments);
    EXPECT_EQ(run.exitCode, 1) << named;
    EXPECT_NE(run.err.find(named), std::string::npos) << run.err;
  }
  EXPECT_EQ(filesIn(folder), 0u);
}

TEST(BakeCommand, AMissingFolderEndsWithTwoBeforeAnythingIsBaked) {
  const ProgramRun run = runProgram("weft-bake", {"-o", "/no/such/folder/x.zip", "--pattern", "weave"});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_NE(run.err.find("/no/such/folder"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace weft::test
