// What programs leave and answer when they are ended, or when nobody listens. tests/faults/run does
// more of it, and longer.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "ClothZip.h"
#include "ProgramRun.h"
#include "TestSupport.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::clothZip;
using test::ProgramRun;
using testing::HasSubstr;

class BadEnd : public testing::Test {
 protected:
  /// Runs a line of bash in the folder, with the programs on its PATH.
  ProgramRun shell(const std::string& line) const {
    return test::runProgram("/bin/bash", {"-c", "cd '" + folder.string() + "'; PATH='" +
                                                    test::programFolder().string() + "':$PATH; " + line});
  }

  std::vector<std::string> temporaries() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().starts_with(".weft")) names.push_back(entry.path());
    return names;
  }

  const fs::path folder = test::testFolder();
};

TEST_F(BadEnd, ResultsThatCannotBePrintedEndWithTwo) {
  clothZip(folder);
  for (const char* command : {"weft-info cloth.zip", "weft-info cloth.zip --json -", "weft-fit --help"})
    for (const char* redirection : {">&-", ">/dev/full"}) {
      const ProgramRun run = shell(std::string(command) + ' ' + redirection);
      EXPECT_EQ(run.exitCode, 2) << command << redirection;
      EXPECT_THAT(run.err, HasSubstr("stdout: writing failed: "));
    }
  const ProgramRun broken = shell("(sleep 0.2; weft-info cloth.zip; echo $? > code) | :");
  EXPECT_EQ(broken.err, "weft-info: stdout: writing failed: Broken pipe\n");
  EXPECT_EQ(shell("cat code").out, "2\n");
}

TEST_F(BadEnd, MessagesThatCannotBePrintedChangeNothing) {
  for (const char* redirection : {"2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&- 2>&-"}) {
    EXPECT_EQ(shell(std::string("weft-info absent.zip ") + redirection).exitCode, 2) << redirection;
    EXPECT_EQ(shell(std::string("weft-info --absent ") + redirection).exitCode, 1) << redirection;
  }
}

TEST_F(BadEnd, ReportsGoThroughWhatTheShellGives) {
  clothZip(folder);
  for (const char* line :
       {"weft-info cloth.zip --json /dev/stdout", "weft-info cloth.zip --json >(cat) | cat",
        "weft-info cloth.zip --json - >> log; cat log"}) {
    const ProgramRun run = shell(line);
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_THAT(run.out, HasSubstr("\"views\": 81")) << line;
  }
}

TEST_F(BadEnd, InputsAreNotAppendedTo) {
  const fs::path zip = clothZip(folder);
  const auto bytes = fs::file_size(zip);
  EXPECT_EQ(shell("weft-info cloth.zip >> cloth.zip").exitCode, 2);
  EXPECT_EQ(fs::file_size(zip), bytes);
}

TEST_F(BadEnd, TheNextRunRemovesWhatAKilledOneLeft) {
  const std::string bake = "weft-bake --pattern tiles --size 2 --samples 1 -o tiles.zip --quiet ";
  const fs::path zip = folder / "tiles.zip";
  // Killed as soon as there is something in its temporary; a busy machine may look too late.
  do {
    fs::remove(zip);
    shell(bake +
          "& until [[ -n $(find . -name '.weft*' -size +0) || ! -d /proc/$! ]]; do :; done; "
          "kill -KILL $!; wait");
  } while (fs::exists(zip));
  EXPECT_FALSE(temporaries().empty());
  EXPECT_EQ(shell(bake).exitCode, 0);
  EXPECT_THAT(temporaries(), testing::IsEmpty());
}

TEST_F(BadEnd, AFileThatMayGrowNoFurtherIsAMessage) {
  std::ofstream(folder / "tiles.zip") << "old";
  const ProgramRun run = shell(
      "ulimit -f 64; weft-bake --pattern tiles --size 2 --samples 1 -o tiles.zip 2>&1 | cat; "
      "exit ${PIPESTATUS[0]}");
  EXPECT_EQ(run.exitCode, 2) << run.out;
  EXPECT_THAT(run.out, HasSubstr("weft-bake: "));
  EXPECT_THAT(temporaries(), testing::IsEmpty());
  EXPECT_EQ(fs::file_size(folder / "tiles.zip"), 3u);
}

TEST_F(BadEnd, AnEndUnderMpiLeavesNoTemporaries) {
#ifdef WEFT_MPIRUN
  clothZip(folder);
  for (const char* seconds : {"0.3", "0.6", "0.9", "1.2"}) {
    shell(std::string("export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; timeout ") +
          seconds + " " WEFT_MPIRUN " --oversubscribe -n 2 weft-fit cloth.zip -o cloth.rf.exr --model laf");
    EXPECT_THAT(temporaries(), testing::IsEmpty());
    const fs::path parts = folder / "cloth.rf.exr.parts";
    if (!fs::exists(parts)) continue;
    for (const auto& entry : fs::directory_iterator(parts))
      EXPECT_FALSE(entry.path().filename().string().starts_with(".weft-"));
  }
#else
  GTEST_SKIP() << "built without MPI";
#endif
}

}  // namespace
}  // namespace weft
