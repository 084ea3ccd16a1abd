#include <fmt/format.h>

#include <algorithm>

#include "FileCollection.h"
#include "FilePath.h"
#include "weft/core/Checksum.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// A folder of more was not meant: a root, a home.
constexpr std::size_t kMostFiles = 1'000'000;

class FolderCollection : public FileCollection {
 public:
  FolderCollection(fs::path folder, std::vector<std::string> names)
      : folder_(std::move(folder)), names_(std::move(names)) {}

  const std::vector<std::string>& names() const override { return names_; }
  Result<std::vector<std::uint8_t>> read(int index) const override {
    return readFileBytes(folder_ / names_[static_cast<std::size_t>(index)], kLargestImageFile);
  }
  Result<std::uint64_t> checksum(int index) const override {
    WEFT_TRY(const std::vector<std::uint8_t> bytes, read(index));
    return checksumOf(std::as_bytes(std::span(bytes)));
  }

 private:
  fs::path folder_;
  std::vector<std::string> names_;
};

}  // namespace

Result<std::unique_ptr<FileCollection>> openFolder(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code error;
  fs::recursive_directory_iterator entry(path, error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    std::string name = entry->path().lexically_relative(path).generic_string();
    if (isClutter(name)) {
      entry.disable_recursion_pending();
      continue;
    }
    if (!entry->is_directory(error)) names.push_back(std::move(name));
    if (names.size() > kMostFiles)
      return fail(fmt::format("the folder holds more than {} files", kMostFiles), path.string(),
                  "give the folder of the measurement alone");
  }
  if (error) return fail("the folder cannot be read: " + error.message(), path.string());
  std::sort(names.begin(), names.end());
  return listedFiles(path, std::move(names));
}

std::unique_ptr<FileCollection> listedFiles(fs::path folder, std::vector<std::string> names) {
  return std::make_unique<FolderCollection>(std::move(folder), std::move(names));
}

}  // namespace weft
