#include "weft/core/AtomicFile.h"

#include <fstream>
#include <mutex>
#include <set>
#include <utility>

#include "LockedTemporary.h"
#include "OutputTarget.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// An interruption concerns the whole process, so what it has to remove is known to the whole
// process.
struct Pending {
  std::mutex mutex;
  std::set<LockedTemporary*> temporaries;
  std::set<fs::path> sweptFolders;
  bool interrupted = false;
};

Pending& pending() {
  static Pending& instance =
      *new Pending;  // never destroyed: an interruption may come while the program ends
  return instance;
}

}  // namespace

struct AtomicFile::Data {
  OutputTarget target;
  LockedTemporary temporary;

  Data(OutputTarget target_, LockedTemporary temporary_)
      : target(std::move(target_)), temporary(std::move(temporary_)) {}
};

Result<AtomicFile> AtomicFile::create(const fs::path& wanted) {
  WEFT_TRY(OutputTarget target, OutputTarget::find(wanted));
  WEFT_TRY(const fs::path folder, target.temporaryFolder());
  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  if (all.interrupted) return fail("interrupted", wanted.string());
  if (all.sweptFolders.insert(folder).second) LockedTemporary::sweep(folder);
  auto temporary = LockedTemporary::create(folder, target.temporaryPermissions());
  if (!temporary)
    return fail("the output cannot be written: " + temporary.error().what, wanted.string(),
                temporary.error().hint);
  auto data = std::make_unique<Data>(std::move(target), std::move(*temporary));
  all.temporaries.insert(&data->temporary);
  return AtomicFile(std::move(data));
}

AtomicFile::AtomicFile(std::unique_ptr<Data> data) : data_(std::move(data)) {}
AtomicFile::AtomicFile(AtomicFile&& other) noexcept = default;

AtomicFile::~AtomicFile() {
  if (!data_) return;
  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  if (all.temporaries.erase(&data_->temporary) > 0) data_->temporary.remove();
}

const fs::path& AtomicFile::temporary() const {
  return data_->temporary.path();
}

Result<void> AtomicFile::commit() {
  const OutputTarget& target = data_->target;
  if (target.isStream()) return target.writeThrough(temporary());
  WEFT_TRY_VOID(target.finish(temporary()));
  Pending& all = pending();
  {
    const std::scoped_lock lock(all.mutex);
    if (all.interrupted) return fail("interrupted", target.name());
    WEFT_TRY_VOID(target.replaceBy(temporary()));
    all.temporaries.erase(&data_->temporary);
    data_->temporary.remove();  // what is beside it
  }
  return target.syncFolder();
}

void AtomicFile::sweep(const fs::path& folder) {
  LockedTemporary::sweep(folder);
}

void AtomicFile::removeAllPending() {
  Pending& all = pending();
  const std::scoped_lock lock(all.mutex);
  all.interrupted = true;
  for (LockedTemporary* temporary : all.temporaries) temporary->remove();
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
