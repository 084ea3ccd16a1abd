#include "NearbyFiles.h"

#include <algorithm>
#include <set>

#include "FilePath.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Relative to the list's; its own comes first.
std::vector<std::string> foldersNear(const LightListLines& list) {
  std::vector<std::string> folders{""};
  std::set<std::string> others{"jpeg-exports", "../jpeg-exports"};
  for (const ListedLight& light : list.lights) {
    const std::string folder(folderOf(light.image));
    if (folder.empty()) continue;
    const std::string name(fileNameOf(folder));
    others.insert({folder, name, "../" + name});
  }
  folders.insert(folders.end(), others.begin(), others.end());
  return folders;
}

std::string withoutTrailingSlash(const fs::path& path) {
  const std::string text = path.lexically_normal().generic_string();
  return text == "." ? std::string() : text.substr(0, text.size() - (text.ends_with('/') ? 1 : 0));
}

}  // namespace

std::vector<std::string> filesNear(const fs::path& folder, const LightListLines& list) {
  std::vector<std::string> names;
  std::set<fs::path> seen;
  for (const std::string& near : foldersNear(list)) {
    std::error_code error;
    const fs::path place = fs::canonical(folder / near, error);
    if (error || !seen.insert(place).second) continue;
    fs::directory_iterator entry(place, error);
    for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      std::error_code unknown;
      if (!isClutter(name) && entry->is_regular_file(unknown))
        names.push_back((fs::path(near) / name).generic_string());
    }
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> namesNear(const std::string& list, const std::vector<std::string>& names,
                                   const LightListLines& lines) {
  const fs::path folder(folderOf(list));
  std::set<std::string> places;
  for (const std::string& near : foldersNear(lines)) places.insert(withoutTrailingSlash(folder / near));
  std::vector<std::string> near;
  for (const std::string& name : names) {
    const bool isNear = places.contains(std::string(folderOf(name)));
    near.push_back(isNear ? fs::path(name).lexically_relative(folder).generic_string() : std::string());
  }
  return near;
}

}  // namespace weft
