#include "OutputTarget.h"

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "Descriptor.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

std::string reason(int error = errno) {
  return std::generic_category().message(error);
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// N of "/dev/fd/N" and "/proc/self/fd/N", however the folder is called.
std::optional<int> descriptorNamed(const fs::path& path) {
  std::error_code error;
  const std::string name = path.filename().string();
  int number = 0;
  const auto [end, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (wrong != std::errc() || end != name.data() + name.size()) return std::nullopt;
  if (!fs::equivalent(folderOf(path), "/proc/self/fd", error)) return std::nullopt;
  return number;
}

bool writeAll(int descriptor, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(descriptor, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return true;
}

bool copyAll(int from, int to) {
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t count = read(from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0;
    if (!writeAll(to, buffer.data(), static_cast<std::size_t>(count))) return false;
  }
}

}  // namespace

tl::unexpected<Error> OutputTarget::failed(const std::string& what, std::string hint) const {
  return fail(what, name(), std::move(hint));
}

Result<OutputTarget> OutputTarget::find(const fs::path& wanted) {
  OutputTarget target(wanted);
  if (wanted.filename().empty()) return target.failed("the output is a folder", "give a file name");
  WEFT_TRY_VOID(target.followLinks());
  WEFT_TRY_VOID(target.lookAt());
  return target;
}

Result<void> OutputTarget::followLinks() {
  constexpr int kMostLinks = 40;  // as Linux
  for (int links = 0; links <= kMostLinks; ++links) {
    descriptor_ = descriptorNamed(path_);
    std::error_code error;
    if (descriptor_ || !fs::is_symlink(fs::symlink_status(path_, error))) return {};
    const fs::path next = fs::read_symlink(path_, error);
    if (error) return failed("the output cannot be written: " + error.message());
    path_ = folderOf(path_) / next;
  }
  return failed("the output cannot be written: " + reason(ELOOP));
}

Result<void> OutputTarget::lookAt() {
  struct stat there {};
  if (descriptor_) {
    const int flags = fcntl(*descriptor_, F_GETFL);
    stream_ = true;
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) return failed("the output is not open for writing");
    return {};
  }
  if (stat(path_.c_str(), &there) != 0) {
    if (errno != ENOENT) return failed("the output cannot be written: " + reason());
    std::error_code error;
    if (fs::is_directory(folderOf(path_), error)) return {};
    return failed("the folder of the output does not exist", "make the folder first");
  }
  if (S_ISDIR(there.st_mode)) return failed("the output is a folder", "give a file name");
  if (S_ISBLK(there.st_mode)) return failed("the output is a disk", "give a file name");
  if (S_ISSOCK(there.st_mode)) return failed("the output is a socket", "give a file name");
  if (access(path_.c_str(), W_OK) != 0) return failed("the output cannot be written: " + reason());
  stream_ = !S_ISREG(there.st_mode);
  if (!stream_) replaced_ = there;
  return {};
}

Result<fs::path> OutputTarget::temporaryFolder() const {
  if (!stream_) return folderOf(path_);
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (error) return failed("there is no folder for temporary files: " + error.message(), "set TMPDIR");
  return folder;
}

Result<void> OutputTarget::finish(const fs::path& temporary) const {
  const Descriptor file(open(temporary.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.isOpen()) return failed("the output cannot be written: " + reason());
  if (replaced_) {
    // Others may own what is replaced; only its mode is a promise. A new owner takes setuid away,
    // so it comes first.
    const bool kept = fchown(file.number(), replaced_->st_uid, replaced_->st_gid) == 0;
    if (fchmod(file.number(), replaced_->st_mode & (kept ? 07777 : 0777)) != 0)
      return failed("the mode of the output cannot be kept: " + reason());
  }
  if (fsync(file.number()) != 0)
    return failed("the output cannot be written: " + reason(), "is the disk full?");
  return {};
}

Result<void> OutputTarget::replaceBy(const fs::path& temporary) const {
  if (rename(temporary.c_str(), path_.c_str()) != 0)
    return failed("cannot be renamed into place: " + reason());
  return {};
}

Result<void> OutputTarget::syncFolder() const {
  const Descriptor folder(open(folderOf(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder may be writable and not readable, and some file systems know no such call.
  if (!folder.isOpen() || fsync(folder.number()) == 0 || errno == EINVAL) return {};
  return failed("the output may be lost in a power cut: " + reason());
}

Result<void> OutputTarget::writeThrough(const fs::path& temporary) const {
  const Descriptor from(open(temporary.c_str(), O_RDONLY | O_CLOEXEC));
  const Descriptor to(descriptor_ ? fcntl(*descriptor_, F_DUPFD_CLOEXEC, 0)
                                  : open(path_.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
  if (!from.isOpen() || !to.isOpen() || !copyAll(from.number(), to.number()))
    return failed("writing failed: " + reason());
  return {};
}

}  // namespace weft
