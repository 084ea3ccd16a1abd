#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Finds the images that a light list means among those that are there: by path, else by name, else
/// by name without its extension; each without difference of case and of Unicode's normal forms.
class ImageFinder {
 public:
  struct Match {
    int file = 0;
    bool hasOtherExtension = false;
  };

  /// `files`: paths relative to the list's folder, '/' between their parts; empty ones are passed
  /// over.
  explicit ImageFinder(std::vector<std::string> files);

  /// Nothing where no file fits. Fails, naming both, where two fit equally well: of several, the
  /// one in the same folder fits best, then the one in a folder of the same name, then the one in
  /// the same case.
  Result<std::optional<Match>> find(std::string_view listed) const;

  int count() const { return static_cast<int>(files_.size()); }
  const std::string& name(int file) const { return files_[static_cast<std::size_t>(file)]; }

 private:
  using Index = std::unordered_map<std::string, std::vector<int>>;

  Result<std::optional<Match>> findIn(const Index& index, const std::string& key,
                                      std::string_view listed) const;

  std::vector<std::string> files_;
  Index paths_;
  Index names_;
  Index stems_;
  Index others_;  ///< names of files that are no JPEGs or PNGs
};

}  // namespace weft
