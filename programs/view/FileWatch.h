#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace weft {

/// Tells when files are written anew, by their sizes and times of change.
class FileWatch {
 public:
  /// These files, as they are now, instead of those before.
  void watch(const std::vector<std::filesystem::path>& files);
  /// Whether one of them is another than it was, and has stayed so since the call before, so that a
  /// file that is just being written is left alone. Once a change.
  bool changed();

 private:
  struct Stamp {
    std::uintmax_t size = 0;
    std::filesystem::file_time_type time{};

    bool operator==(const Stamp&) const = default;
  };
  using Stamps = std::map<std::filesystem::path, Stamp>;

  Stamps look() const;

  Stamps known_;   ///< when watch() was called, or at the latest change told
  Stamps latest_;  ///< at the latest look
};

}  // namespace weft
