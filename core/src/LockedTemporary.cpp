#include "LockedTemporary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "Descriptor.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".weft-";
constexpr std::string_view kPart = ".part";
constexpr std::string_view kLock = ".lock";

// Locks tell nothing of processes on other machines that share a file system.
std::string hostName() {
  std::array<char, 65> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  std::ranges::replace(name, '/', '_');
  return name.data();
}

/// Where a file system does not, every temporary looks like a leftover.
bool knowsLocks(const fs::path& folder) {
  const Descriptor opened(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return opened.isOpen() && (flock(opened.number(), LOCK_SH | LOCK_NB) == 0 || errno == EWOULDBLOCK);
}

std::vector<fs::path> filesIn(const fs::path& folder, std::string_view prefix, std::string_view suffix) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(suffix)) files.push_back(entry->path());
  }
  return files;
}

void removeWithCompanions(const fs::path& part) {
  for (const fs::path& file : filesIn(part.parent_path(), part.filename().string(), "")) unlink(file.c_str());
}

}  // namespace

LockedTemporary::LockedTemporary(fs::path part, FileLock lock)
    : part_(std::move(part)), lock_(std::move(lock)) {}

Result<LockedTemporary> LockedTemporary::create(const fs::path& folder, mode_t permissions) {
  static std::atomic<unsigned> made = 0;
  for (;;) {
    const fs::path name = folder / fmt::format("{}{}-{}@{}", kPrefix, getpid(), made++, hostName());
    fs::path part = name, lock = name;
    part += kPart;
    lock += kLock;
    WEFT_TRY(std::optional<FileLock> held, FileLock::tryAcquire(lock));
    if (!held) continue;         // a sweep is at a leftover of this name
    removeWithCompanions(part);  // it may be one itself
    const Descriptor file(open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions));
    if (file.isOpen()) return LockedTemporary(std::move(part), std::move(*held));
    return fail(std::generic_category().message(errno), folder.string(), "is the disk full?");
  }
}

void LockedTemporary::sweep(const fs::path& folder) {
  if (!knowsLocks(folder)) return;
  for (fs::path& lock : filesIn(folder, kPrefix, fmt::format("@{}{}", hostName(), kLock))) {
    // The lock goes last: what is beside it is never without one.
    const auto held = FileLock::tryAcquire(lock);
    if (held && *held) removeWithCompanions(lock.replace_extension(kPart));
  }
}

void LockedTemporary::remove() {
  removeWithCompanions(part_);
  lock_.release();
}

}  // namespace weft
