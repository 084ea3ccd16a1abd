#include "weft/core/FileLock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace weft {
namespace {

bool isThere(int descriptor) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

}  // namespace

FileLock::FileLock(std::filesystem::path file, int descriptor)
    : file_(std::move(file)), descriptor_(descriptor) {}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock::~FileLock() {
  release();
}

// The file goes first: who opens it before that finds that it is not there any more.
void FileLock::release() {
  if (descriptor_ < 0) return;
  unlink(file_.c_str());
  close(std::exchange(descriptor_, -1));
}

Result<std::optional<FileLock>> FileLock::tryAcquire(const std::filesystem::path& file) {
  for (;;) {
    const int descriptor = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (descriptor < 0) {
      const int error = errno;
      return fail(
          "the lock cannot be made: " + std::generic_category().message(error), file.string(),
          error == ENOSPC || error == EDQUOT ? "is the disk full?" : "check the folder's permissions");
    }
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close(descriptor);
      return std::nullopt;
    }
    if (isThere(descriptor)) return FileLock(file, descriptor);
    close(descriptor);  // its owner has removed it in between
  }
}

}  // namespace weft
