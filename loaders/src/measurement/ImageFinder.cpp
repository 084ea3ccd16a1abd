#include "ImageFinder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "FilePath.h"
#include "TextEncoding.h"
#include "weft/io/FileName.h"

namespace weft {
namespace {

std::string keyOf(std::string_view name) {
  return foldedName(nameInUtf8(name));
}

std::string pathKeyOf(std::string_view path) {
  const std::string normal = std::filesystem::path(path).lexically_normal().generic_string();
  return normal == "." ? std::string() : keyOf(normal);
}

// Keeps those that `fits` holds for, or all where it holds for none.
template <class Function>
void prefer(std::vector<int>& files, const Function& fits) {
  if (std::ranges::any_of(files, fits)) std::erase_if(files, [&](int file) { return !fits(file); });
}

}  // namespace

ImageFinder::ImageFinder(std::vector<std::string> files) : files_(std::move(files)) {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    const std::string& file = files_[i];
    const int index = static_cast<int>(i);
    if (file.empty()) continue;
    if (!isReadableImage(file)) {
      others_[keyOf(fileNameOf(file))].push_back(index);
      continue;
    }
    paths_[pathKeyOf(file)].push_back(index);
    names_[keyOf(fileNameOf(file))].push_back(index);
    stems_[keyOf(stemOf(file))].push_back(index);
  }
}

Result<std::optional<ImageFinder::Match>> ImageFinder::findIn(const Index& index, const std::string& key,
                                                              std::string_view listed) const {
  const auto found = index.find(key);
  if (found == index.end()) return std::optional<Match>();
  std::vector<int> fitting = found->second;
  const std::string folder = pathKeyOf(folderOf(listed));
  const std::string folderName = keyOf(fileNameOf(folderOf(listed)));
  prefer(fitting, [&](int i) { return pathKeyOf(folderOf(name(i))) == folder; });
  prefer(fitting, [&](int i) { return keyOf(fileNameOf(folderOf(name(i)))) == folderName; });
  prefer(fitting, [&](int i) { return fileNameOf(name(i)) == fileNameOf(listed); });
  if (fitting.size() > 1)
    return fail(fmt::format("'{}' may be '{}' or '{}'", listed, name(fitting[0]), name(fitting[1])), {},
                "rename or remove one of the two");
  return std::optional<Match>({fitting[0], false});
}

Result<std::optional<ImageFinder::Match>> ImageFinder::find(std::string_view listed) const {
  WEFT_TRY(std::optional<Match> match, findIn(paths_, pathKeyOf(listed), listed));
  if (match) return match;
  WEFT_TRY(match, findIn(names_, keyOf(fileNameOf(listed)), listed));
  if (match) return match;
  WEFT_TRY(match, findIn(stems_, keyOf(stemOf(listed)), listed));
  if (match) match->hasOtherExtension = true;
  if (match) return match;
  return findIn(others_, keyOf(fileNameOf(listed)), listed);
}

}  // namespace weft
