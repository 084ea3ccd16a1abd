#include "FileWatch.h"

#include <system_error>
#include <utility>

namespace weft {

void FileWatch::watch(const std::vector<std::filesystem::path>& files) {
  known_.clear();
  for (const std::filesystem::path& file : files) known_[file];
  known_ = latest_ = look();
}

bool FileWatch::changed() {
  const Stamps before = std::exchange(latest_, look());
  if (latest_ == known_ || latest_ != before) return false;
  known_ = latest_;
  return true;
}

FileWatch::Stamps FileWatch::look() const {
  Stamps stamps;
  for (const auto& [file, stamp] : known_) {
    std::error_code missing;
    Stamp now{std::filesystem::file_size(file, missing), {}};
    now.time = std::filesystem::last_write_time(file, missing);
    // What is away for a moment, as editors do it, has not changed yet.
    stamps[file] = missing ? stamp : now;
  }
  return stamps;
}

}  // namespace weft
