#pragma once

#include <sys/types.h>

#include <filesystem>

#include "weft/core/FileLock.h"

namespace weft {

/// A hidden file that belongs to this process while it lives: ".weft-PID-N@HOST.part", and beside
/// it a .lock that the process holds. A process that dies without removing them loses the lock, so
/// that a later sweep() knows them for leftovers.
///
/// The lock has a file of its own because some libraries replace what they write to by another
/// file.
class LockedTemporary {
 public:
  /// An empty file in `folder` that grants `permissions`, less the umask.
  static Result<LockedTemporary> create(const std::filesystem::path& folder, mode_t permissions);
  /// Removes from `folder` what dead processes of this host have left there; says nothing of what
  /// it cannot.
  static void sweep(const std::filesystem::path& folder);

  /// The path to write to; libraries may put further files beside it whose names begin with it.
  const std::filesystem::path& path() const { return part_; }
  /// Removes the file, if it is still there, what libraries put beside it, and the lock.
  void remove();

 private:
  LockedTemporary(std::filesystem::path part, FileLock lock);

  std::filesystem::path part_;
  FileLock lock_;
};

}  // namespace weft
