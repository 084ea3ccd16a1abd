// The samples and scripts that docs/your-*.md follow.
#include <gtest/gtest.h>

#include "ConstantField.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

// How much light is in a picture.
double brightness(const std::filesystem::path& file) {
  const Image picture = test::valueOf(readImage(file));
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sum += picture.pixel(x, y)[1];
  return sum;
}

class StartSamples : public testing::Test {
 protected:
  // A script of samples/, as a user calls it.
  void runScript(const std::string& name, const std::vector<std::string>& arguments) {
    const auto run = test::runProgram(test::sourceFolder() / "samples" / name, arguments);
    ASSERT_EQ(run.exitCode, 0) << run.err;
  }

  std::filesystem::path folder = test::testFolder();
};

TEST_F(StartSamples, ALightMovesFromTheFrontOfAClothBehindIt) {
  test::writeConstantField(folder / "white.rf.exr", {0.8f, 0.8f, 0.8f});
  const auto run = test::runProgram("moving-light", {folder / "white.rf.exr", folder / "light", "2"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_GT(brightness(folder / "light-0.png"), 2.0 * brightness(folder / "light-1.png"));
  EXPECT_EQ(test::runProgram("moving-light", {"none.rf.exr", folder / "light", "2"}).exitCode, 2);
}

TEST_F(StartSamples, AModelOfOnesOwnIsFittedToWhatWasBakedAndDrawn) {
  const std::string zip = folder / "weave.zip", field = folder / "own.rf.exr", picture = folder / "own.png";
  ASSERT_EQ(test::runProgram("weft-bake", {"--pattern", "weave", "--size", "4", "-o", zip}).exitCode, 0);
  const auto run = test::runProgram("own-model", {zip, field, picture});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_NE(run.out.find("stored luminance"), std::string::npos);
  EXPECT_GT(brightness(picture), 0.0);
  const auto info = test::runProgram("weft-info", {field});  // which does not know the model
  EXPECT_EQ(info.exitCode, 2);
  EXPECT_NE(info.err.find("unknown model 'slope'"), std::string::npos) << info.err;
}

TEST_F(StartSamples, TheMaterialsOfGltfAreAllRead) {
  runScript("gltf-materials.py", {folder / "materials.gltf"});
  const auto run = test::runProgram("weft-info", {folder / "materials.gltf"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_NE(run.out.find("transmission"), std::string::npos);
  EXPECT_EQ(run.err, "");
}

TEST_F(StartSamples, TheStoolHasThreeMaterialsAndMetres) {
  runScript("stool.py", {folder / "stool.glb"});
  const auto run = test::runProgram("weft-info", {folder / "stool.glb"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  for (const char* line : {"materials.0.name         seat", "materials.1.name         wood",
                           "materials.2.name         floor", "materials.2.unit_length  1.0"})
    EXPECT_NE(run.out.find(line), std::string::npos) << line << " in\n" << run.out;
  EXPECT_EQ(run.err, "");
}

TEST_F(StartSamples, ASetOfTexturesIsBakedWithoutAWarning) {
  runScript("bricks.py", {folder});
  const std::string zip = folder / "bricks.zip";
  const auto run = test::runProgram(
      "weft-bake", {"--height", folder / "height.png", "--depth", "0.03", "--albedo", folder / "albedo.png",
                    "--roughness", folder / "roughness.png", "--size", "4", "-o", zip, "--quiet"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_NE(run.out.find("4 x 4 texels, 81 views x 81 lights"), std::string::npos) << run.out;
  EXPECT_EQ(run.err, "");
}

TEST_F(StartSamples, TheViewFromTheTopOfAMeasurementIsAnRti) {
  const std::string zip = folder / "tiles.zip";
  ASSERT_EQ(test::runProgram("weft-bake", {"--pattern", "tiles", "--size", "4", "-o", zip}).exitCode, 0);
  runScript("rti.py", {zip, folder / "relief"});
  const auto run = test::runProgram("weft-info", {folder / "relief/relief.lp"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_NE(run.out.find("views                    1\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("lights                   81\n"), std::string::npos) << run.out;
  EXPECT_EQ(run.err, "");
}

}  // namespace
}  // namespace weft
