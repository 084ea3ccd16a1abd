#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// The files of a folder or a zip, by name, without clutter (FilePath.h). Thread safe.
class FileCollection {
 public:
  virtual ~FileCollection() = default;

  /// Paths relative to the folder or zip, '/' between their parts.
  virtual const std::vector<std::string>& names() const = 0;
  /// The contents of names()[index]; fails where they are damaged or larger than kLargestImageFile.
  virtual Result<std::vector<std::uint8_t>> read(int index) const = 0;
  /// A checksum of the contents of names()[index].
  virtual Result<std::uint64_t> checksum(int index) const = 0;
};

/// All files below a folder, sorted by name. Fails on a folder that may not be read, and on more
/// than a million files.
Result<std::unique_ptr<FileCollection>> openFolder(const std::filesystem::path& path);

/// Files named relative to a folder.
std::unique_ptr<FileCollection> listedFiles(std::filesystem::path folder, std::vector<std::string> names);

/// All files in a zip, in its order. Fails on damage that its list of files shows.
Result<std::unique_ptr<FileCollection>> openZip(const std::filesystem::path& path);

}  // namespace weft
