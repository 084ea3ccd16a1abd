#include "weft/tool/Tool.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "CommandLineError.h"
#include "Interruption.h"
#include "OutputCheck.h"
#include "StandardStreams.h"
#include "weft/core/AtomicFile.h"
#include "weft/tool/ProgressPrinter.h"

namespace weft {

struct Tool::Data {
  ToolDescription description;
  CLI::App app;
  bool quiet = false;
  int threads = 0;
  std::filesystem::path json;
  std::vector<const CLI::Option*> outputs;
  std::vector<std::filesystem::path> files;   ///< what these name, but for stdout
  std::vector<std::filesystem::path> inputs;  ///< what other options name, and what those files do
  std::unique_ptr<tbb::global_control> threadLimit;
  int stdoutError = 0;  ///< errno of the first text that could not be printed

  /// Whether stdout belongs to the report, also by another name.
  bool jsonOnStdout() const {
    std::error_code ignored;
    return json == "-" || std::filesystem::equivalent(json, "/dev/stdout", ignored);
  }

  void printMessage(const std::string& message) const {
    const char* freshLine = isatty(STDERR_FILENO) ? "\r\x1b[K" : "";
    printText(stderr, fmt::format("{}{}: {}\n", freshLine, description.name, message));
  }

  void printOut(const std::string& text) {
    if (!printText(stdout, text) && stdoutError == 0) stdoutError = errno;
  }

  ExitCode badUsage(const std::string& message) const {
    printMessage(message + " (see --help)");
    return ExitCode::BadUsage;
  }

  std::optional<ExitCode> parse(int argc, const char* const* argv);
  void findFiles();
  Result<void> checkOutputs() const;
  ExitCode parseAndWork(int argc, const char* const* argv, const std::function<Result<ExitCode>()>& work);
};

/// The exit code where the command line leaves no work: bad options, --help.
std::optional<ExitCode> Tool::Data::parse(int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) return badUsage(explain(app, error));
    std::ostringstream text;
    app.exit(error, text, text);
    printOut(text.str());
    return ExitCode::Done;
  }
  if (const auto message = findNotANumber(app)) return badUsage(*message);
  return std::nullopt;
}

void Tool::Data::findFiles() {
  std::vector<std::string> words;
  for (const CLI::Option* option : app.get_options()) {
    const bool isOutput = std::ranges::find(outputs, option) != outputs.end();
    for (const std::string& word : option->results())
      if (!isOutput)
        words.push_back(word);
      else if (word != "-" || option->get_name() != "--json")
        files.emplace_back(word);
  }
  inputs = existingFiles(words);
}

Result<void> Tool::Data::checkOutputs() const {
  WEFT_TRY_VOID(checkStdout(inputs));
  for (const std::filesystem::path& file : files) WEFT_TRY_VOID(checkOutputFile(file, inputs));
  return checkDistinct(files);
}

ExitCode Tool::Data::parseAndWork(int argc, const char* const* argv,
                                  const std::function<Result<ExitCode>()>& work) {
  if (const auto code = parse(argc, argv)) return *code;
  if (threads > 0)
    threadLimit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                        static_cast<std::size_t>(threads));
  findFiles();
  const Result<void> writable = checkOutputs();  // before the work, which may take hours
  const Result<ExitCode> result = writable ? work() : tl::unexpected<Error>(writable.error());
  if (result) return *result;
  printMessage(result.error().message());
  return ExitCode::BadInput;
}

Tool::Tool(ToolDescription description) : data_(std::make_unique<Data>()) {
  fillClosedStreams();
  endCleanlyWhenInterrupted();
  data_->description = std::move(description);
  CLI::App& app = data_->app;
  app.name(data_->description.name);
  app.description(data_->description.purpose);
  app.footer("Example:\n  " + data_->description.example);
  app.set_version_flag("--version", data_->description.name + " " + data_->description.version);
  app.add_flag("--quiet", data_->quiet, "print no progress");
  app.add_option("--threads", data_->threads, "threads to use; 0: all")->check(CLI::Range(0, 4096));
  addOutput("--json", data_->json, "write what was done and measured to this file; -: stdout");
}

Tool::~Tool() = default;

CLI::App& Tool::options() {
  return data_->app;
}

CLI::Option* Tool::addOutput(const std::string& name, std::filesystem::path& file, const std::string& help) {
  CLI::Option* option = data_->app.add_option(name, file, help);
  data_->outputs.push_back(option);
  return option;
}

int Tool::run(int argc, const char* const* argv, const std::function<Result<ExitCode>()>& work) {
  ExitCode code = ExitCode::BadInput;
  try {  // so that outputs are removed even when memory or threads run out
    code = data_->parseAndWork(argc, argv, work);
  } catch (const std::bad_alloc&) {
    data_->printMessage("out of memory");
  } catch (const std::exception& error) {
    data_->printMessage(error.what());
  }
  if (data_->stdoutError != 0) {
    data_->printMessage("stdout: writing failed: " + std::generic_category().message(data_->stdoutError));
    code = ExitCode::BadInput;
  }
  return static_cast<int>(code);
}

ExitCode Tool::badUsage(const std::string& message) const {
  return data_->badUsage(message);
}

void Tool::print(const std::string& text) const {
  if (!data_->jsonOnStdout()) data_->printOut(text);
}

void Tool::warn(const std::string& message) const {
  data_->printMessage(message);
}

Result<void> Tool::checkOutput(const std::filesystem::path& file) const {
  return checkOutputFile(file, data_->inputs);
}

Progress Tool::progress(std::string label, double amount, std::string unit) const {
  if (data_->quiet) return {};
  auto printer = std::make_shared<ProgressPrinter>(std::move(label), amount, std::move(unit),
                                                   isatty(STDERR_FILENO) != 0);
  return [printer](double fraction) { printer->update(fraction); };
}

Result<void> Tool::protect(const std::vector<std::filesystem::path>& inputs) const {
  data_->inputs.insert(data_->inputs.end(), inputs.begin(), inputs.end());
  return data_->checkOutputs();
}

int Tool::threads() const {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

Result<void> Tool::writeJson(const nlohmann::ordered_json& report) const {
  if (data_->json.empty()) return {};
  const std::string text =
      report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (!data_->jsonOnStdout()) return writeWholeFile(data_->json, text);
  data_->printOut(text);  // run() tells a failure
  return {};
}

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

nlohmann::ordered_json fileBytes(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  return error ? nlohmann::ordered_json() : nlohmann::ordered_json(bytes);
}

}  // namespace weft
