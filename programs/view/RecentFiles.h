#pragma once

#include <filesystem>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// The files that a viewer showed last, the latest first, kept in a file of lines.
class RecentFiles {
 public:
  /// Those that the file names; none where there is no such file.
  explicit RecentFiles(std::filesystem::path file);

  const std::vector<std::filesystem::path>& files() const { return files_; }
  /// Puts a file first, and writes the list. Fails where that cannot be written.
  Result<void> add(const std::filesystem::path& opened);

  /// $XDG_STATE_HOME/weft/recent, or that in ~/.local/state; empty where neither is known.
  static std::filesystem::path standardFile();

 private:
  std::filesystem::path file_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace weft
