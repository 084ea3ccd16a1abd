#include "weft/core/AtomicFile.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <mutex>
#include <set>
#include <utility>

namespace weft {
namespace {

namespace fs = std::filesystem;

// An interruption concerns the whole process, so what it has to remove is known to the whole process.
struct Pending {
  std::mutex mutex;
  std::set<fs::path> temporaries;
  bool interrupted = false;
  unsigned made = 0;
};

Pending& pending() {
  static Pending& instance =
      *new Pending;  // never destroyed: an interruption may come while the program ends
  return instance;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Libraries that write beside the given path (libzip) append to its name.
void removeWithCompanions(const fs::path& temporary) {
  std::error_code ignored;
  const std::string prefix = temporary.filename().string();
  for (fs::directory_iterator entry(folderOf(temporary), ignored), end; entry != end;
       entry.increment(ignored)) {
    if (ignored) break;
    if (entry->path().filename().string().starts_with(prefix)) fs::remove(entry->path(), ignored);
  }
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const fs::path& target) {
  std::error_code ignored;
  if (target.filename().empty() || fs::is_directory(target, ignored))
    return fail("the output is a folder", target.string(), "give a file name");
  if (!fs::is_directory(folderOf(target), ignored))
    return fail("the folder of the output does not exist", target.string(), "make the folder first");

  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  if (all.interrupted) return fail("interrupted", target.string());
  const fs::path temporary = folderOf(target) / fmt::format(".{}.{}-{}.part", target.filename().string(),
                                                            static_cast<long>(getpid()), all.made++);
  if (!std::ofstream(temporary, std::ios::binary))
    return fail("the output cannot be written", target.string(), "check the folder's permissions");
  all.temporaries.insert(temporary);
  return AtomicFile(target, temporary);
}

AtomicFile::AtomicFile(fs::path target, fs::path temporary)
    : target_(std::move(target)), temporary_(std::move(temporary)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)), temporary_(std::exchange(other.temporary_, {})) {}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  removeWithCompanions(temporary_);
  all.temporaries.erase(temporary_);
}

Result<void> AtomicFile::commit() {
  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  if (all.interrupted) return fail("interrupted", target_.string());
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) return fail("cannot be renamed into place: " + error.message(), target_.string());
  all.temporaries.erase(temporary_);
  temporary_.clear();
  return {};
}

void AtomicFile::removeAllPending() {
  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  all.interrupted = true;
  for (const fs::path& temporary : all.temporaries) removeWithCompanions(temporary);
  all.temporaries.clear();
}

Result<void> writeWholeFile(const fs::path& target, std::string_view contents) {
  WEFT_TRY(AtomicFile file, AtomicFile::create(target));
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream << contents;
  stream.close();
  if (!stream) return fail("writing failed", target.string(), "is the disk full?");
  return file.commit();
}

}  // namespace weft
