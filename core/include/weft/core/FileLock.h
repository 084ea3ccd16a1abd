#pragma once

#include <filesystem>
#include <optional>

#include "weft/core/Result.h"

namespace weft {

/// A file that one owner on one machine or, where the file system allows, on several holds at a
/// time. It is free again when its owner dies, however that happens, and is removed where the owner
/// ends in order.
class FileLock {
 public:
  /// Makes the file. Nothing where someone else holds it; fails where it cannot be made. Where a
  /// file system knows no locks, nobody is kept out.
  static Result<std::optional<FileLock>> tryAcquire(const std::filesystem::path& file);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&&) = delete;
  ~FileLock();

  /// Removes the file and lets it go, as the end of its owner does.
  void release();

 private:
  FileLock(std::filesystem::path file, int descriptor);

  std::filesystem::path file_;
  int descriptor_;  ///< negative when moved from
};

}  // namespace weft
