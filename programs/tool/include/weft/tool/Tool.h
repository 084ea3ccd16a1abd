#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/core/Version.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace weft {

/// What every program of Weft ends with.
enum class ExitCode {
  Done = 0,
  BadUsage = 1,
  BadInput = 2,     ///< or failing I/O, a full stdout included
  BoundMissed = 3,  ///< a quality bound that the user gave
};

/// What `--help` and `--version` say of a program.
struct ToolDescription {
  std::string name;     ///< "weft-fit"
  std::string purpose;  ///< one sentence
  std::string example;  ///< one command line
  std::string version = WEFT_VERSION;
};

/// What all command line programs share: options, exit codes, messages, progress, `--json`,
/// interruption.
///
///     weft::Tool tool({"weft-fit", "Fits ...", "weft-fit wool.zip -o wool.rf.exr"});
///     // include <CLI/CLI.hpp>
///     tool.options().add_option("INPUT", input, "what to fit")->required();
///     tool.addOutput("-o", output, "the .rf.exr to write")->required();
///     return tool.run(argc, argv, [&]() -> weft::Result<weft::ExitCode> { ... });
///
/// Every program gets --help, --version, --quiet, --threads and --json.
class Tool {
 public:
  /// Make it first in main(), before any thread (those of MPI included): an interruption (Ctrl-C,
  /// SIGTERM, SIGHUP, ...) from then on removes what AtomicFile has not committed and ends the
  /// program.
  explicit Tool(ToolDescription description);
  ~Tool();

  /// To add the program's own options to.
  CLI::App& options();
  /// The same for the name of a file that is written: run() finds out before the work whether it
  /// can be, and refuses to replace a file that another option names as input. Include
  /// <CLI/CLI.hpp>.
  CLI::Option* addOutput(const std::string& name, std::filesystem::path& file, const std::string& help);

  /// Parses the command line, then does `work`, and returns the exit code for main(). A failure of
  /// `work`, or an exception, is printed as "NAME: message" and ends with BadInput; so does an
  /// output that cannot be written. Bad options end with BadUsage. In both cases `work` has not
  /// started.
  int run(int argc, const char* const* argv, const std::function<Result<ExitCode>()>& work);

  /// For options that are wrong together: prints the message; return what it returns.
  ExitCode badUsage(const std::string& message) const;

  /// Prints a result for people on stdout, unless `--json -` wants that for itself. Where stdout is
  /// full or closed, run() ends with BadInput.
  void print(const std::string& text) const;
  /// Prints "NAME: message" on stderr: what was assumed, dropped or guessed. --quiet keeps it.
  void warn(const std::string& message) const;
  /// Prints progress on stderr: on a terminal one line with rate and time left, else a line every
  /// 10 s, with --quiet nothing. `amount` `unit`s ("texels") are done at fraction 1; 0 prints no
  /// rate.
  Progress progress(std::string label, double amount = 0.0, std::string unit = {}) const;

  /// For outputs that no option names as they are (numbered pictures, files of a folder): the
  /// checks that addOutput() promises. Call it before the work.
  Result<void> checkOutput(const std::filesystem::path& file) const;

  /// Adds files that an input names itself, as a glTF does its images, to what no output may
  /// replace, and checks the outputs again. Call it before anything is written.
  Result<void> protect(const std::vector<std::filesystem::path>& inputs) const;

  /// The number of threads that TBB may use.
  int threads() const;
  /// Writes the report of `--json FILE` ("-": stdout); nothing without the option.
  Result<void> writeJson(const nlohmann::ordered_json& report) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// The largest resident memory of this process so far.
std::uint64_t peakMemoryBytes();

/// The size of a file for a report; null for what is no regular file, as a pipe.
nlohmann::ordered_json fileBytes(const std::filesystem::path& file);

}  // namespace weft
