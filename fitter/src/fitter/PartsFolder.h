#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "RowRange.h"
#include "weft/core/FileLock.h"
#include "weft/core/Result.h"

namespace weft {

/// A folder of files that each hold what a pass of a fit has made of some rows.
///
/// They let a fit go on after it was stopped, and let several processes share one. They are for the
/// kind of machine that wrote them, not for exchange.
class PartsFolder {
 public:
  /// Takes the contents of a file; false where they are not what such rows have.
  using Take = std::function<bool(RowRange rows, std::span<const std::byte> contents)>;

  /// `fingerprint` says everything that decides the contents: files of another fit are refused. An
  /// empty `path` keeps nothing.
  PartsFolder(std::filesystem::path path, std::string fingerprint)
      : path_(std::move(path)), fingerprint_(std::move(fingerprint)) {}
  PartsFolder(const PartsFolder&) = delete;
  PartsFolder& operator=(const PartsFolder&) = delete;
  ~PartsFolder();

  bool keepsRows() const { return !path_.empty(); }
  /// Makes the folder and keeps other fits from claiming it while this one lives; removes what
  /// programs that were killed have left half-written. Fails where another fit has it.
  Result<void> claim();
  /// Writes a file; makes the folder.
  Result<void> write(int pass, RowRange rows, std::span<const std::byte> contents) const;
  /// Hands over every file of a pass; the folder may be missing. Fails on files that are damaged,
  /// of another fit or, all in all, larger than `largest`; `height` is that of the field.
  Result<void> read(int pass, int height, std::size_t largest, const Take& take) const;
  /// Removes the files that write() made, and the folder where nothing else is in it.
  void remove() const;

 private:
  Result<void> make() const;
  void removeIfEmpty() const;
  Result<void> readFile(const std::filesystem::path& file, int pass, int height, std::size_t largest,
                        const Take& take) const;

  std::filesystem::path path_;
  std::string fingerprint_;
  std::optional<FileLock> lock_;
};

}  // namespace weft
