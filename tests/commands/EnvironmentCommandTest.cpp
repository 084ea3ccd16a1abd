#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "OlderFields.h"
#include "ProgramRun.h"
#include "TestSupport.h"
#include "weft/core/AtomicFile.h"
#include "weft/io/ExrFile.h"

namespace weft::test {
namespace {

using testing::HasSubstr;

class EnvironmentCommand : public testing::Test {
 protected:
  void SetUp() override { ::setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1); }

  ProgramRun render(std::vector<std::string> more) const {
    std::vector<std::string> arguments{"shape:sphere", "-o", output, "--size", "40x30", "--json", "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram("weft-render", arguments);
  }
  /// A picture of one radiance, in which a value is none.
  std::string picture() const {
    FloatImage image(4, 2, {"R", "G", "B"});
    std::ranges::fill(image.values(), 0.5f);
    image.at(1, 1, 2) = std::numeric_limits<float>::quiet_NaN();
    requireDone(writeExr(folder / "grey.exr", image));
    return (folder / "grey.exr").string();
  }

  const std::filesystem::path folder = testFolder();
  const std::string output = (folder / "out.exr").string();
};

TEST_F(EnvironmentCommand, LightsExposesAndWarns) {
  const std::string environment = picture();
  const ProgramRun run = render({"--env", environment, "--exposure", "1", "--env-rotation", "-30"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("no numbers"));
  EXPECT_EQ(nlohmann::json::parse(run.out)["environment"], environment);
  const FloatImage shown = valueOf(readExr(output));
  const int red = *shown.channelIndex("R");
  EXPECT_NEAR(shown.at(20, 15, red), 1.0f, 0.01f);  // white in grey of 0.5, a stop brighter
  EXPECT_NEAR(shown.at(0, 0, red), 1.0f, 0.01f);
  EXPECT_TRUE(std::filesystem::exists(folder / "cache" / "weft"));

  // Tone mapping is for pictures that are looked at, or where it is asked for.
  ASSERT_EQ(render({"--env", environment, "--exposure", "1", "--tone-map", "soft", "--quiet"}).exitCode, 0);
  EXPECT_NEAR(valueOf(readExr(output)).at(20, 15, red), 0.9f, 0.01f);
  ASSERT_EQ(render({"--env", environment, "--show", "specular", "--env-lobes", "paper"}).exitCode, 0);
  EXPECT_EQ(valueOf(readExr(output)).at(20, 15, red), 0.0f);  // a diffuse sphere
}

TEST_F(EnvironmentCommand, FieldsWithoutAFormulaForEnvironmentsAreSlowWhichIsSaid) {
  for (const auto& [field, isSlow] : {std::pair("lfp", true), {"rfp", false}}) {
    const std::string file = (olderFieldsFolder() / field).string() + ".rf.exr";
    const ProgramRun run = render({"--env", "studio", "--material", "*=" + file});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err.find("adds up 9 measured lights, which is slow") != std::string::npos, isSlow)
        << field << ": " << run.err;
  }
}

TEST_F(EnvironmentCommand, WhatIsWrongIsSaid) {
  requireDone(writeWholeFile(folder / "text.hdr", "#?RADIANCE\n\n-Y 2 +X 4\n"));
  for (const auto& [file, message] : {std::pair((folder / "text.hdr").string(), "text.hdr"),
                                      std::pair(std::string("cellar"), "built in are studio and sky")}) {
    const ProgramRun run = render({"--env", file});
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(run.err, HasSubstr(message));
  }
  EXPECT_EQ(render({"--env", "sky", "--exposure", "nan"}).exitCode, 1);
  EXPECT_EQ(render({"--env", "sky", "--env-rotation", "inf"}).exitCode, 1);
  EXPECT_EQ(render({"--tone-map", "hard"}).exitCode, 1);
  EXPECT_FALSE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace weft::test
