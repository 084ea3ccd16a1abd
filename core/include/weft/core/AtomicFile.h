#pragma once

#include <filesystem>
#include <string_view>

#include "weft/core/Result.h"

namespace weft {

/// An output file that appears whole or not at all: write to `temporary()`, then commit().
///
/// The temporary lies in the target's folder, and is removed when the object dies uncommitted or the program
/// is interrupted (removeAllPending()). Any thread may own one; one object is for one thread.
class AtomicFile {
 public:
  /// Fails where the target's folder does not exist or cannot be written to, or the target is a folder.
  static Result<AtomicFile> create(const std::filesystem::path& target);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// The path to write to; libraries may put further files beside it whose names begin with it.
  const std::filesystem::path& temporary() const { return temporary_; }
  /// Renames the temporary to the target, replacing what was there.
  Result<void> commit();

  /// For the end of an interrupted program: removes every uncommitted temporary and lets no file be created
  /// or committed afterwards. Not for signal handlers: it locks.
  static void removeAllPending();

 private:
  AtomicFile(std::filesystem::path target, std::filesystem::path temporary);

  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty once committed or moved from
};

/// A whole file by way of an AtomicFile; fails where it cannot be written or the disk is full.
Result<void> writeWholeFile(const std::filesystem::path& target, std::string_view contents);

}  // namespace weft
