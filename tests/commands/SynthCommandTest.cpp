#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ImageFile.h"

namespace weft::test {
namespace {

std::string synthFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string bakedTiles(const std::filesystem::path& folder, const std::string& size) {
  const std::string zip = (folder / ("tiles" + size + ".zip")).string();
  const ProgramRun run =
      runProgram("weft-bake", {"-o", zip, "--pattern", "tiles", "--size", size, "--samples", "1", "--quiet"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  return zip;
}

TEST(SynthCommand, WritesTheMapOfAMeasurementItsPreviewAndAPage) {
  const std::filesystem::path folder = testFolder();
  const std::string input = bakedTiles(folder, "20");
  const ProgramRun run = runProgram(
      "weft-synth", {input, "-o", (folder / "tiles.coords.exr").string(), "--size", "70", "50", "--preview",
                     (folder / "tiles.png").string(), "--report", (folder / "tiles.html").string(), "--json",
                     (folder / "tiles.json").string(), "--quiet"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const CoordinateMap map = valueOf(readCoordinateMap(folder / "tiles.coords.exr"));
  EXPECT_EQ(map.width(), 70);
  EXPECT_EQ(map.height(), 50);
  EXPECT_EQ(map.sampleWidth(), 20);
  const Image preview = valueOf(readImage(folder / "tiles.png"));
  EXPECT_EQ(preview.width, 70);
  EXPECT_EQ(preview.height, 50);
  const auto json = nlohmann::json::parse(synthFile(folder / "tiles.json"));
  EXPECT_EQ(json["method"], "patches");
  EXPECT_LE(json["seams"]["visibility"][0], 1.1);
  EXPECT_GT(json["appearance"]["kept_variance"], 0.5);
  const std::string page = synthFile(folder / "tiles.html");
  for (const char* text : {"View (0, 0)", "View (45, 0)", "View (75, 0)", "Tiled.", "data:image/png"})
    EXPECT_THAT(page, testing::HasSubstr(text));
}

TEST(SynthCommand, WhatIsWrongEndsWithAMessageAndNoFile) {
  const std::filesystem::path folder = testFolder();
  const std::string input = bakedTiles(folder, "8"), output = (folder / "x.coords.exr").string();
  const ProgramRun small = runProgram("weft-synth", {input, "-o", output, "--size", "64", "64"});
  EXPECT_EQ(small.exitCode, 2);
  EXPECT_THAT(small.err, testing::HasSubstr("8 x 8 sources"));
  for (const std::vector<std::string>& bad :
       std::vector<std::vector<std::string>>{{"--size", "64"},
                                             {"--size", "64", "4"},
                                             {"--size", "64", "64", "--method", "quilt"},
                                             {"--size", "64", "64", "-k", "11"}}) {
    std::vector<std::string> arguments{input, "-o", output};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    EXPECT_EQ(runProgram("weft-synth", arguments).exitCode, 1);
  }
  EXPECT_FALSE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace weft::test
