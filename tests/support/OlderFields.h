#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "TestSupport.h"

namespace weft::test {

/// The folder of fields that an older Weft wrote, for every model and manifest 2: NAME.rf.exr, with
/// what that Weft's `weft-eval --image 40 50 35 200` gave for it as NAME.values.exr, and as
/// NAME.picture.exr the picture of `weft-render shape:plane --camera 0.3,0.4,1:0,0,0
/// --light=-1,1,1.5 --size 10x8`.
inline std::filesystem::path olderFieldsFolder() {
  return sourceFolder() / "tests/data/manifest2";
}

/// Their names, sorted.
inline std::vector<std::string> olderFields() {
  constexpr std::string_view kExtension = ".rf.exr";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(olderFieldsFolder()))
    if (const std::string name = entry.path().filename().string(); name.ends_with(kExtension))
      names.push_back(name.substr(0, name.size() - kExtension.size()));
  std::ranges::sort(names);
  return names;
}

}  // namespace weft::test
