#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>

#include "weft/core/Result.h"

namespace weft {

/// Where an output goes when symbolic links are followed: a regular file, there already or not, or
/// something that is written through and never replaced, as pipes and terminals are.
class OutputTarget {
 public:
  /// Fails for folders, disks, sockets, files that must not be written and missing folders.
  static Result<OutputTarget> find(const std::filesystem::path& wanted);

  /// What messages call it.
  std::string name() const { return wanted_.string(); }
  bool isStream() const { return stream_; }
  /// Where a temporary of it belongs: beside it, or for a stream the system's folder for such
  /// files.
  Result<std::filesystem::path> temporaryFolder() const;
  /// Permissions of a temporary, which let nobody read what they may not read in its place.
  mode_t temporaryPermissions() const { return replaced_ ? (replaced_->st_mode & 0666) | 0600 : 0666; }

  /// Gives a finished temporary the mode and, where that is allowed, the owner of what it replaces,
  /// and waits until the disk has it.
  Result<void> finish(const std::filesystem::path& temporary) const;
  /// Puts a temporary beside it into its place; syncFolder() makes that last.
  Result<void> replaceBy(const std::filesystem::path& temporary) const;
  Result<void> syncFolder() const;
  /// Copies a finished temporary into a stream; waits for who reads a pipe.
  Result<void> writeThrough(const std::filesystem::path& temporary) const;

 private:
  explicit OutputTarget(std::filesystem::path wanted) : wanted_(wanted), path_(std::move(wanted)) {}
  Result<void> followLinks();
  Result<void> lookAt();
  tl::unexpected<Error> failed(const std::string& what, std::string hint = {}) const;

  std::filesystem::path wanted_;
  std::filesystem::path path_;
  /// of a stream that this process has open, as /dev/stdout is
  std::optional<int> descriptor_;
  std::optional<struct stat> replaced_;  ///< the regular file that is there
  bool stream_ = false;
};

}  // namespace weft
