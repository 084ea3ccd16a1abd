#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "PatternPictures.h"
#include "ProgramRun.h"
#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/Color.h"
#include "weft/io/ExrFile.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

using nlohmann::json;
using test::ProgramRun;
using testing::HasSubstr;

class DiffCommand : public testing::Test {
 protected:
  DiffCommand() {
    writeStored("a.png", test::smoothPicture(0));
    writeStored("b.png", test::smoothPicture(1));
  }

  void writeStored(const std::string& name, const FloatImage& stored) const {
    test::requireDone(writePng(folder / name, test::imageOf(40, 32, [&](int x, int y, int c) {
                                 return static_cast<int>(255.0f * stored.at(x, y, c) + 0.5f);
                               })));
  }

  void writeLinear(const std::string& name, FloatImage stored, float gain) const {
    for (float& value : stored.values()) value = gain * decode(Encoding::Srgb, value);
    test::requireDone(writeExr(folder / name, stored));
  }

  ProgramRun diff(const std::string& a, const std::string& b, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {(folder / a).string(), (folder / b).string()});
    return test::runProgram("weft-diff", more);
  }

  json report(const std::string& a, const std::string& b, std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--json", "-"});
    const ProgramRun run = diff(a, b, more);
    EXPECT_EQ(run.exitCode, 0) << run.err;
    return json::parse(run.out);
  }

  const std::filesystem::path folder = test::testFolder();
};

// Numbers: numpy, scikit-image and the program of FLIP's authors, as in the tests of the metrics.
TEST_F(DiffCommand, TellsAllMetrics) {
  const json found = report("a.png", "b.png");
  EXPECT_NEAR(found["difference"]["mean"], 0.01808108660, 1e-7);
  EXPECT_NEAR(found["difference"]["max"], 0.07843137255, 1e-7);
  EXPECT_NEAR(found["difference"]["rmse"], 0.03313697693, 1e-7);
  EXPECT_NEAR(found["difference"]["psnr"], 29.5937, 1e-3);
  EXPECT_NEAR(found["ssim"]["mean"], 0.8764465781, 1e-5);
  EXPECT_NEAR(found["flip"]["mean"], 0.1626736161, 1e-4);
  EXPECT_EQ(found["values"], "srgb");
  const ProgramRun same = diff("a.png", "a.png", {"--max", "0", "--mean", "0"});
  EXPECT_EQ(same.exitCode, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("psnr inf dB"));
}

TEST_F(DiffCommand, EndsWithThreeAboveABound) {
  EXPECT_EQ(diff("a.png", "b.png", {"--max", "0.079", "--mean", "0.019"}).exitCode, 0);
  for (const std::vector<std::string>& bound : {std::vector<std::string>{"--max", "0.078"},
                                                {"--mean", "0.018"},
                                                {"--metric", "ssim", "--mean", "0.12"},
                                                {"--metric", "flip", "--mean", "0.16"}}) {
    const ProgramRun run = diff("a.png", "b.png", bound);
    EXPECT_EQ(run.exitCode, 3) << bound.front();
    EXPECT_THAT(run.err, HasSubstr("is above --"));
  }
  EXPECT_EQ(diff("a.png", "b.png", {"--metric", "ssim", "--mean", "0.13"}).exitCode, 0);
  EXPECT_EQ(diff("a.png", "b.png", {"--max", "nan"}).exitCode, 1);
}

// An EXR of the same picture is the same; two of them are compared by their values.
TEST_F(DiffCommand, ComparesLinearPicturesAsTheyAreOrAsAScreenShowsThem) {
  writeLinear("a.exr", test::smoothPicture(0), 1.0f);
  writeLinear("bright.exr", test::smoothPicture(0), 3.0f);
  const json same = report("a.exr", "a.png");
  EXPECT_EQ(same["values"], "srgb");
  EXPECT_LT(same["difference"]["max"], 1e-5);
  const json linear = report("a.exr", "bright.exr", {"--metric", "difference"});
  EXPECT_EQ(linear["values"], "linear");
  EXPECT_GT(linear["difference"]["max"], 1.9);
  EXPECT_FALSE(linear.contains("flip"));
  EXPECT_THAT(diff("a.png", "bright.exr").err, HasSubstr("above 1, and are compared as a screen shows them"));
}

TEST_F(DiffCommand, WhatIsNoNumberIsNeverRight) {
  FloatImage picture = test::smoothPicture(0);
  writeLinear("a.exr", picture, 1.0f);
  picture.at(20, 16, 1) = std::numeric_limits<float>::quiet_NaN();
  test::requireDone(writeExr(folder / "nan.exr", picture));
  for (const char* metric : {"difference", "ssim", "flip"}) {
    const ProgramRun run =
        diff("nan.exr", "nan.exr", {"--metric", metric, "--max", "0.9", "-o", folder / "errors.exr"});
    EXPECT_EQ(run.exitCode, 3) << metric;
    EXPECT_THAT(run.err, HasSubstr("nan.exr: 1 of its pixels are infinite or not a number"));
    const FloatImage errors = test::valueOf(readExr(folder / "errors.exr"));
    const int margin = (40 - errors.width()) / 2;
    EXPECT_GE(errors.at(20 - margin, 16 - margin, 1), 1.0f) << metric;
  }
}

TEST_F(DiffCommand, DrawsTheErrors) {
  ASSERT_EQ(diff("a.png", "b.png", {"-o", folder / "errors.png"}).exitCode, 0);
  const Image errors = test::valueOf(readImage(folder / "errors.png"));
  EXPECT_EQ(errors.pixel(0, 0)[0], 0);
  // Red differs by 20 / 255, which as light is 79 / 255.
  EXPECT_EQ(errors.pixel(7, 1)[0], 79);
  EXPECT_EQ(diff("a.png", "b.png", {"-o", folder / "errors.jpg"}).exitCode, 1);
}

TEST_F(DiffCommand, TransparencyCountsAsBlack) {
  Image clear(40, 32, 4), black(40, 32, 3);
  std::ranges::fill(clear.bytes, std::uint8_t{255});
  for (std::size_t i = 3; i < clear.bytes.size(); i += 4) clear.bytes[i] = 0;
  test::requireDone(writePng(folder / "clear.png", clear));
  test::requireDone(writePng(folder / "black.png", black));
  const ProgramRun run = diff("clear.png", "black.png", {"--max", "0"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.err, HasSubstr("clear.png: what is transparent is laid on black"));
}

TEST_F(DiffCommand, RefusesWhatCannotBeCompared) {
  test::requireDone(writePng(folder / "small.png", Image(9, 32, 3)));
  std::ofstream(folder / "text.png") << "hello";
  const std::string output = folder / "errors.png";
  const auto refused = [&](const std::string& a, const std::string& b, std::vector<std::string> more = {}) {
    more.insert(more.end(), {"-o", output});
    const ProgramRun run = diff(a, b, more);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_FALSE(std::filesystem::exists(output));
    return run.err;
  };
  EXPECT_THAT(refused("a.png", "small.png"), HasSubstr("small.png: it has 9 x 32 pixels"));
  EXPECT_THAT(refused("a.png", "text.png"), HasSubstr("text.png: this is a text, not a picture"));
  EXPECT_THAT(refused("none.png", "a.png"), HasSubstr("none.png: no such file"));
  EXPECT_THAT(refused("small.png", "small.png", {"--metric", "ssim"}), HasSubstr("the pictures are smaller"));
  EXPECT_EQ(diff("small.png", "small.png").exitCode, 0);
}

}  // namespace
}  // namespace weft
