#include "LockedTemporary.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

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

// Where a file system knows no locks, owners go without, and nothing is ever swept.
bool isHeld(const Descriptor& lock, bool withoutLocks) {
  struct stat status {};
  if (flock(lock.number(), LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || !withoutLocks)) return false;
  // nobody has removed it in between
  return fstat(lock.number(), &status) == 0 && status.st_nlink > 0;
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

// The lock goes last: what is beside it is then never without one.
void removeBoth(const fs::path& part, const fs::path& lock) {
  for (const fs::path& file : filesIn(part.parent_path(), part.filename().string(), "")) unlink(file.c_str());
  unlink(lock.c_str());
}

tl::unexpected<Error> cannotWrite(int error, const fs::path& folder) {
  return fail(std::generic_category().message(error), folder.string(),
              error == ENOSPC || error == EDQUOT ? "is the disk full?" : "check the folder's permissions");
}

}  // namespace

LockedTemporary::LockedTemporary(fs::path part, fs::path lock, Descriptor held)
    : part_(std::move(part)), lock_(std::move(lock)), held_(std::move(held)) {}

Result<LockedTemporary> LockedTemporary::create(const fs::path& folder, mode_t permissions) {
  static std::atomic<unsigned> made = 0;
  for (;;) {
    const std::string name = fmt::format("{}{}-{}@{}", kPrefix, getpid(), made++, hostName());
    const fs::path part = folder / fmt::format("{}{}", name, kPart);
    const fs::path lock = folder / fmt::format("{}{}", name, kLock);
    Descriptor held(open(lock.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    if (!held.isOpen() && errno == EEXIST) continue;
    if (!held.isOpen()) return cannotWrite(errno, folder);
    if (!isHeld(held, true)) continue;  // a sweep of another process was quicker
    const Descriptor file(open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions));
    if (file.isOpen()) return LockedTemporary(part, lock, std::move(held));
    const int error = errno;
    unlink(lock.c_str());
    if (error != EEXIST) return cannotWrite(error, folder);
  }
}

void LockedTemporary::sweep(const fs::path& folder) {
  for (const fs::path& lock : filesIn(folder, kPrefix, fmt::format("@{}{}", hostName(), kLock))) {
    const Descriptor held(open(lock.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (held.isOpen() && isHeld(held, false)) removeBoth(fs::path(lock).replace_extension(kPart), lock);
  }
}

void LockedTemporary::remove() const {
  removeBoth(part_, lock_);
}

}  // namespace weft
