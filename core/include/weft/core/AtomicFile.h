#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "weft/core/Result.h"

namespace weft {

/// An output file that appears whole or not at all: write to `temporary()`, then commit().
///
/// Symbolic links are followed, and a file that is there is replaced by one of its mode and owner.
/// What is no file but can be written to (a pipe, a terminal, /dev/stdout) is never replaced:
/// commit() copies into it.
///
/// The temporary lies in the target's folder (for what is no file, in the system's folder for
/// temporary files), and is removed when the object dies uncommitted or the program is interrupted
/// (removeAllPending()). What programs of this host left there when they were killed is removed by
/// the first create() in that folder. Any thread may own one; one object is for one thread.
class AtomicFile {
 public:
  /// Fails where the target's folder does not exist or cannot be written to, or the target is a
  /// folder, a disk, a socket or a file that must not be written to.
  static Result<AtomicFile> create(const std::filesystem::path& target);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// The path to write to; libraries may put further files beside it whose names begin with it.
  const std::filesystem::path& temporary() const;
  /// Renames the temporary to the target, replacing what was there, and waits until the disk has
  /// both: what depends on the file may go once this has returned. Once, at the end.
  Result<void> commit();

  /// Removes what programs of this host left in a folder when they were killed. create() does so
  /// for the first file in one.
  static void sweep(const std::filesystem::path& folder);
  /// For the end of an interrupted program: removes every uncommitted temporary and lets no file be
  /// created or committed afterwards. Not for signal handlers: it locks.
  static void removeAllPending();

 private:
  struct Data;
  explicit AtomicFile(std::unique_ptr<Data> data);

  std::unique_ptr<Data> data_;  ///< none when moved from
};

/// A whole file by way of an AtomicFile; fails where it cannot be written or the disk is full.
Result<void> writeWholeFile(const std::filesystem::path& target, std::string_view contents);

}  // namespace weft
