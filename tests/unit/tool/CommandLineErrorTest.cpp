#include <gmock/gmock.h>

#include <CLI/CLI.hpp>

#include "Suggestion.h"
#include "weft/tool/Tool.h"

namespace weft {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What a program with an option of each kind says on stderr.
std::string messageFor(const std::vector<std::string>& arguments) {
  Tool tool({"weft-test", "Does nothing.", "weft-test --size 4", "1.2.3"});
  std::string model;
  int size = 0, views = 3;
  double scale = 1.0, exposure = 0.0, turn = 0.0;
  CLI::App& app = tool.options();
  app.add_option("--model", model)->check(CLI::IsMember({"laf", "slaf", "rfnl"}));
  app.add_option("--views", views)->check(CLI::IsMember({1, 3}));
  app.add_option("--size", size)->check(CLI::Range(1, 1024));
  app.add_option("--scale", scale)->check(CLI::PositiveNumber);
  app.add_option("--exposure", exposure)->check(CLI::Range(-60.0, 60.0));
  app.add_option("--turn", turn);
  std::vector<const char*> argv{"weft-test"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  testing::internal::CaptureStderr();
  const int code = tool.run(static_cast<int>(argv.size()), argv.data(),
                            []() -> Result<ExitCode> { return ExitCode::Done; });
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_EQ(code, message.empty() ? 0 : 1);
  return message;
}

TEST(CommandLineError, SuggestsTheOptionThatWasMeant) {
  EXPECT_THAT(messageFor({"--modle", "laf"}),
              HasSubstr("there is no option --modle (did you mean --model?)"));
  EXPECT_THAT(messageFor({"--exposur=3"}), HasSubstr("--exposur (did you mean --exposure?)"));
  EXPECT_THAT(messageFor({"--Quiet"}), HasSubstr("(did you mean --quiet?)"));
  EXPECT_THAT(messageFor({"--environment", "x"}), Not(HasSubstr("did you mean")));
}

TEST(CommandLineError, SuggestsTheWordThatWasMeant) {
  EXPECT_THAT(messageFor({"--model", "rfln"}),
              HasSubstr("--model takes one of laf, slaf, rfnl, not \"rfln\" (did you mean rfnl?)"));
  EXPECT_THAT(messageFor({"--model", "magic"}),
              testing::AllOf(HasSubstr("not \"magic\""), Not(HasSubstr("did you mean"))));
  EXPECT_THAT(messageFor({"--views", "x"}), HasSubstr("--views takes one of 1, 3, not \"x\""));
}

TEST(CommandLineError, NamesOptionAndRange) {
  for (const char* size : {"0", "many", "3.5", "99999999999999999999"})
    EXPECT_THAT(messageFor({"--size", size}),
                HasSubstr(std::string("--size takes a whole number from 1 to 1024, not \"") + size + '"'));
  EXPECT_THAT(messageFor({"--exposure", "61"}),
              HasSubstr("--exposure takes a number from -60 to 60, not \"61\""));
  EXPECT_THAT(messageFor({"--scale", "-1"}), HasSubstr("--scale takes a number above 0, not \"-1\""));
  EXPECT_THAT(messageFor({"--turn", "left"}), HasSubstr("--turn takes numbers, not \"left\""));
}

TEST(CommandLineError, NanIsNoNumber) {
  for (const char* option : {"--scale", "--exposure", "--turn"})
    EXPECT_THAT(messageFor({option, "nan"}), HasSubstr(std::string(option) + " takes numbers, not \"nan\""));
  EXPECT_EQ(messageFor({"--turn", "1e3", "--exposure", "-2.5"}), "");
}

TEST(Suggestion, CountsLettersThatDiffer) {
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("weave", "weave"), 0u);
  EXPECT_EQ(editDistance("waeve", "weave"), 1u) << "neighbours swapped";
  EXPECT_EQ(editDistance("weve", "weave"), 1u);
  EXPECT_EQ(editDistance("corduroy", "cordoury"), 2u);
  EXPECT_EQ(didYouMean("tile", {"weave", "tiles"}), " (did you mean tiles?)");
  EXPECT_EQ(didYouMean("felt", {"weave", "tiles"}), "");
  EXPECT_EQ(didYouMean("-x", {"-o"}), "");
}

}  // namespace
}  // namespace weft
