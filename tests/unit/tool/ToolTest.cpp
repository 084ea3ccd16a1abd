#include "weft/tool/Tool.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "TestSupport.h"
#include "weft/core/AtomicFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::valueOf;
using testing::AllOf;
using testing::HasSubstr;

/// How a tool named weft-test, with one option --size, ended.
struct Outcome {
  int exitCode = -1;
  std::string out;
  std::string err;
};

using Work = std::function<Result<ExitCode>(const Tool& tool)>;

int runTool(const std::vector<std::string>& arguments, const Work& work) {
  Tool tool({"weft-test", "Does nothing.", "weft-test --size 4", "1.2.3"});
  int size = 0;
  tool.options().add_option("--size", size, "how large")->check(CLI::PositiveNumber);
  std::vector<const char*> argv{"weft-test"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  return tool.run(static_cast<int>(argv.size()), argv.data(), [&] { return work(tool); });
}

Outcome outcomeOf(const std::vector<std::string>& arguments, const Work& work) {
  Outcome outcome;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  outcome.exitCode = runTool(arguments, work);
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

Result<ExitCode> nothing(const Tool&) {
  return ExitCode::Done;
}

TEST(Tool, ExitsWithWhatTheWorkSays) {
  for (ExitCode code : {ExitCode::Done, ExitCode::BadUsage, ExitCode::BadInput, ExitCode::BoundMissed})
    EXPECT_EQ(outcomeOf({}, [&](const Tool&) { return Result<ExitCode>(code); }).exitCode,
              static_cast<int>(code));
}

TEST(Tool, PrintsOneMessageForBadInput) {
  const Outcome outcome = outcomeOf({}, [](const Tool&) -> Result<ExitCode> {
    return fail("the image is truncated", "a.png", "copy it again");
  });
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_EQ(outcome.err, "weft-test: a.png: the image is truncated (copy it again)\n");
  EXPECT_EQ(outcome.out, "");
}

TEST(Tool, ReportsExhaustedMemory) {
  const Outcome outcome = outcomeOf({}, [](const Tool&) -> Result<ExitCode> { throw std::bad_alloc(); });
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_EQ(outcome.err, "weft-test: out of memory\n");
}

TEST(Tool, ReportsExceptions) {
  const Outcome outcome = outcomeOf({}, [](const Tool&) -> Result<ExitCode> {
    throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again), "thread");
  });
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, testing::MatchesRegex("weft-test: thread: Resource temporarily unavailable\n"));
}

TEST(Tool, RefusesBadOptionsBeforeTheWork) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--size", "-3"},
                                                    {"--size", "many"},
                                                    {"--unknown"},
                                                    {"extra"},
                                                    {"--threads", "-1"}}) {
    bool worked = false;
    const Outcome outcome = outcomeOf(arguments, [&](const Tool&) -> Result<ExitCode> {
      worked = true;
      return ExitCode::Done;
    });
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_FALSE(worked);
    EXPECT_THAT(outcome.err, AllOf(testing::StartsWith("weft-test: "), testing::EndsWith("(see --help)\n")));
  }
}

TEST(Tool, HelpsWithAnExample) {
  const Outcome help = outcomeOf({"--help"}, nothing);
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_THAT(help.out,
              AllOf(HasSubstr("Does nothing."), HasSubstr("Example:\n  weft-test --size 4"),
                    HasSubstr("--size"), HasSubstr("--threads"), HasSubstr("--json"), HasSubstr("--quiet")));
  const Outcome version = outcomeOf({"--version"}, nothing);
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_EQ(version.out, "weft-test 1.2.3\n");
}

TEST(Tool, LimitsThreads) {
  int threads = 0;
  const auto ask = [&](const Tool& tool) -> Result<ExitCode> {
    threads = tool.threads();
    return ExitCode::Done;
  };
  outcomeOf({"--threads", "1"}, ask);
  EXPECT_EQ(threads, 1);
  outcomeOf({}, ask);
  EXPECT_EQ(threads, static_cast<int>(std::thread::hardware_concurrency()));
}

TEST(Tool, WritesJsonWhereItIsAskedFor) {
  const auto report = [](const Tool& tool) -> Result<ExitCode> {
    WEFT_TRY_VOID(tool.writeJson({{"views", 81}, {"file", "broken \xff name"}}));
    return ExitCode::Done;
  };
  EXPECT_EQ(outcomeOf({}, report).out, "");
  const Outcome onStdout = outcomeOf({"--json", "-"}, report);
  EXPECT_EQ(nlohmann::json::parse(onStdout.out).at("views"), 81);

  const fs::path file = test::testFolder() / "report.json";
  EXPECT_EQ(outcomeOf({"--json", file.string()}, report).out, "");
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(file)).at("views"), 81);
  EXPECT_EQ(outcomeOf({"--json", "/no/such/folder/report.json"}, report).exitCode, 2);
}

TEST(Tool, PrintsProgressUnlessQuiet) {
  const auto work = [](const Tool& tool) -> Result<ExitCode> {
    const Progress progress = tool.progress("fit", 100.0, "texels");
    for (double fraction : {0.0, 0.5, 1.0, 1.0})
      if (progress) progress(fraction);
    return ExitCode::Done;
  };
  // Not a terminal here: nothing within the first ten seconds but the end.
  EXPECT_THAT(outcomeOf({}, work).err, testing::MatchesRegex("fit done in [0-9.]+ s\n"));
  EXPECT_EQ(outcomeOf({"--quiet"}, work).err, "");
}

TEST(Tool, QuietKeepsResultsAndWarnings) {
  const auto work = [](const Tool& tool) -> Result<ExitCode> {
    tool.print("eps 0.1\n");
    tool.warn("a.png: no such file");
    return ExitCode::Done;
  };
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{}, {"--quiet"}}) {
    const Outcome outcome = outcomeOf(arguments, work);
    EXPECT_EQ(outcome.out, "eps 0.1\n");
    EXPECT_EQ(outcome.err, "weft-test: a.png: no such file\n");
  }
  EXPECT_EQ(outcomeOf({"--json", "-"}, work).out, "") << "stdout belongs to the report";
}

TEST(Tool, KnowsItsPeakMemory) {
  const std::uint64_t before = peakMemoryBytes();
  std::vector<char> block(std::size_t{100} << 20, 'x');
  EXPECT_GT(block[block.size() / 2], 0);
  EXPECT_GT(peakMemoryBytes(), before + (std::uint64_t{50} << 20));
}

TEST(ToolDeathTest, AnInterruptionLeavesNoBrokenFile) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const fs::path folder = test::testFolder();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    const auto interrupted = [&] {
      runTool({}, [&](const Tool&) -> Result<ExitCode> {
        const AtomicFile file = valueOf(AtomicFile::create(folder / "out.txt"));
        std::ofstream(file.temporary()) << "half";
        kill(getpid(), signal);
        sleep(20);
        return ExitCode::Done;
      });
    };
    EXPECT_EXIT(interrupted(), testing::KilledBySignal(signal), "");
    EXPECT_TRUE(fs::is_empty(folder));
  }
}

}  // namespace
}  // namespace weft
