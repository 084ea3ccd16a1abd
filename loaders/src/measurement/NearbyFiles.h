#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "LightListLines.h"

namespace weft {

/// The files among which the images of a list are, relative to its folder: those of this folder, of
/// the folders that its lines name, as they are written or beside and above the list, and of
/// RTIBuilder's `jpeg-exports`, which lies beside the `assembly-files` with the list. Folders in
/// these are not looked at.
std::vector<std::string> filesNear(const std::filesystem::path& folder, const LightListLines& list);

/// The same among `names`, which the list is one of: relative to the list's folder, empty for those
/// elsewhere.
std::vector<std::string> namesNear(const std::string& list, const std::vector<std::string>& names,
                                   const LightListLines& lines);

}  // namespace weft
