#include "weft/tool/Tool.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "weft/core/AtomicFile.h"
#include "weft/core/Contract.h"
#include "weft/tool/ProgressPrinter.h"

namespace weft {
namespace {

// A thread that waits for the signal may lock and allocate, which a signal handler may not. Threads started
// later inherit the blocked signals, so only this one receives them.
void endCleanlyWhenInterrupted() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int signal = 0;
    sigwait(&signals, &signal);
    AtomicFile::removeAllPending();
    _exit(128 + signal);
  }).detach();
}

}  // namespace

struct Tool::Data {
  ToolDescription description;
  CLI::App app;
  bool quiet = false;
  int threads = 0;
  std::string json;
  std::unique_ptr<tbb::global_control> threadLimit;

  void printError(const std::string& message) const {
    const char* freshLine = isatty(STDERR_FILENO) ? "\r\x1b[K" : "";
    fmt::print(stderr, "{}{}: {}\n", freshLine, description.name, message);
  }
};

Tool::Tool(ToolDescription description) : data_(std::make_unique<Data>()) {
  data_->description = std::move(description);
  CLI::App& app = data_->app;
  app.name(data_->description.name);
  app.description(data_->description.purpose);
  app.footer("Example:\n  " + data_->description.example);
  app.set_version_flag("--version", data_->description.name + " " + data_->description.version);
  app.add_flag("--quiet", data_->quiet, "print no progress");
  app.add_option("--threads", data_->threads, "threads to use; 0: all")->check(CLI::Range(0, 4096));
  app.add_option("--json", data_->json, "write what was done and measured to this file; -: stdout");
}

Tool::~Tool() = default;

CLI::App& Tool::options() {
  return data_->app;
}

int Tool::run(int argc, const char* const* argv, const std::function<Result<ExitCode>()>& work) {
  try {
    data_->app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return data_->app.exit(error);  // --help, --version
    return static_cast<int>(badUsage(error.what()));
  }
  endCleanlyWhenInterrupted();
  if (data_->threads > 0)
    data_->threadLimit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                               static_cast<std::size_t>(data_->threads));
  try {  // so that outputs are removed even when memory runs out
    const Result<ExitCode> result = work();
    if (result) return static_cast<int>(*result);
    data_->printError(result.error().message());
  } catch (const std::bad_alloc&) {
    data_->printError("out of memory");
  }
  return static_cast<int>(ExitCode::BadInput);
}

ExitCode Tool::badUsage(const std::string& message) const {
  data_->printError(message + " (see --help)");
  return ExitCode::BadUsage;
}

void Tool::warn(const std::string& message) const {
  data_->printError(message);
}

Progress Tool::progress(std::string label, double amount, std::string unit) const {
  if (data_->quiet) return {};
  auto printer = std::make_shared<ProgressPrinter>(std::move(label), amount, std::move(unit),
                                                   isatty(STDERR_FILENO) != 0);
  return [printer](double fraction) { printer->update(fraction); };
}

bool Tool::quiet() const {
  return data_->quiet;
}

int Tool::threads() const {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

bool Tool::jsonOnStdout() const {
  return data_->json == "-";
}

Result<void> Tool::writeJson(const nlohmann::ordered_json& report) const {
  if (data_->json.empty()) return {};
  const std::string text =
      report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (!jsonOnStdout()) return writeWholeFile(data_->json, text);
  std::cout << text << std::flush;
  if (!std::cout) return fail("writing failed", "stdout");
  return {};
}

std::uint64_t peakMemoryBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace weft
