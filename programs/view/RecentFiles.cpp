#include "RecentFiles.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include "weft/core/AtomicFile.h"

namespace weft {
namespace {

constexpr std::size_t kMost = 12;

std::filesystem::path variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

RecentFiles::RecentFiles(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream lines(file_);
  for (std::string line; files_.size() < kMost && std::getline(lines, line);)
    if (!line.empty()) files_.emplace_back(line);
}

Result<void> RecentFiles::add(const std::filesystem::path& opened) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(opened, error);
  if (error || path.string().find('\n') != std::string::npos) return {};
  if (!files_.empty() && files_.front() == path) return {};
  std::erase(files_, path);
  files_.insert(files_.begin(), path);
  files_.resize(std::min(files_.size(), kMost));
  if (file_.empty()) return {};
  std::filesystem::create_directories(file_.parent_path(), error);
  if (error) return fail("the list of recent files cannot be kept: " + error.message(), file_.string());
  std::string text;
  for (const std::filesystem::path& each : files_) {
    text += each.string();
    text += '\n';
  }
  return writeWholeFile(file_, text);
}

std::filesystem::path RecentFiles::standardFile() {
  if (const auto state = variable("XDG_STATE_HOME"); !state.empty()) return state / "weft" / "recent";
  const std::filesystem::path home = variable("HOME");
  return home.empty() ? home : home / ".local" / "state" / "weft" / "recent";
}

}  // namespace weft
