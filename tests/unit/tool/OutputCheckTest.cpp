#include <gmock/gmock.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "TestSupport.h"
#include "weft/tool/Tool.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// How a tool ended that reads INPUT and --material NAME=FILE, and writes -o and --report.
struct OutputOutcome {
  int exitCode = -1;
  bool worked = false;
  std::string err;
};

OutputOutcome outcomeOf(const std::vector<std::string>& arguments) {
  Tool tool({"weft-test", "Does nothing.", "weft-test a -o b", "1.2.3"});
  std::string input, material;
  fs::path output, report;
  tool.options().add_option("INPUT", input);
  tool.options().add_option("--material", material);
  tool.addOutput("-o", output, "what to write");
  tool.addOutput("--report", report, "a page");
  std::vector<const char*> argv{"weft-test"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  OutputOutcome outcome;
  testing::internal::CaptureStderr();
  outcome.exitCode = tool.run(static_cast<int>(argv.size()), argv.data(), [&outcome]() -> Result<ExitCode> {
    outcome.worked = true;
    return ExitCode::Done;
  });
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

void expectRefused(const std::vector<std::string>& arguments, const std::string& message) {
  const OutputOutcome outcome = outcomeOf(arguments);
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_FALSE(outcome.worked);
  EXPECT_THAT(outcome.err, HasSubstr(message));
}

class OutputCheck : public testing::Test {
 protected:
  std::string file(const std::string& name) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << "text";
    return folder / name;
  }

  const fs::path folder = test::testFolder();
};

TEST_F(OutputCheck, WhatCannotBeWrittenIsToldBeforeTheWork) {
  for (const char* option : {"-o", "--report", "--json"}) {
    expectRefused({option, folder}, "the output is a folder");
    expectRefused({option, folder / "none" / "x"}, "the folder of the output does not exist");
    expectRefused({option, folder / std::string(300, 'x')}, "File name too long");
    expectRefused({option, ""}, "the output is a folder");
  }
  EXPECT_TRUE(fs::is_empty(folder));
  EXPECT_TRUE(outcomeOf({"-o", folder / "x", "--json", "-"}).worked);
  EXPECT_TRUE(fs::is_empty(folder)) << "to find out leaves nothing";
}

TEST_F(OutputCheck, InputsAreNotReplaced) {
  const std::string input = file("m.zip"), field = file("wool.rf.exr");
  fs::create_symlink(input, folder / "soft");
  fs::create_hard_link(input, folder / "hard");
  for (const char* option : {"-o", "--report", "--json"}) {
    for (const fs::path& output : {fs::path(input), folder / "soft", folder / "hard", folder / "." / "m.zip"})
      expectRefused({input, option, output}, "the output would replace an input");
    expectRefused({"--material", "a=" + field, option, field}, "the output would replace an input");
  }
  EXPECT_TRUE(outcomeOf({input, "-o", field}).worked) << "what is no input may be replaced";
}

TEST_F(OutputCheck, PicturesOfAFolderOrLightListAreInputs) {
  const std::string picture = file("m/0/a.JPG"), beside = file("m/old.json"), list = file("m/a.lp");
  expectRefused({folder / "m", "--json", picture}, "the output would replace an input");
  expectRefused({list, "--report", picture}, "the output would replace an input");
  EXPECT_TRUE(outcomeOf({folder / "m", "--json", beside}).worked);
  EXPECT_TRUE(outcomeOf({folder / "m", "--json", folder / "m" / "new.jpg"}).worked);
}

TEST_F(OutputCheck, TwoOutputsAreTwoFiles) {
  expectRefused({"-o", folder / "x", "--report", folder / "." / "x"}, "two outputs are one file");
  EXPECT_TRUE(outcomeOf({"-o", "/dev/null", "--report", "/dev/null"}).worked);
}

}  // namespace
}  // namespace weft
