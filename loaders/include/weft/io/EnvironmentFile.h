#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/core/Result.h"
#include "weft/reflectance/Environment.h"
#include "weft/reflectance/PrefilteredEnvironment.h"

namespace weft {

/// Reads an equirectangular picture, told by its first bytes: Radiance (.hdr) or OpenEXR.
/// `warnings` as Environment::create(), decodeRadiance() and readExrPicture() say. Fails, with file
/// and reason, on damaged files, and on more than 16384 pixels a side or 2^26 in all, before memory
/// is taken.
Result<Environment> readEnvironment(const std::filesystem::path& path, std::vector<std::string>& warnings);

/// Decodes a Radiance picture of any of its kinds (flat, old and new run lengths, RGBE), whichever
/// way its rows or columns run, to channels R, G, B in Rec. 709. A header's exposure and colour
/// correction are undone; what is assumed is added to `warnings`. Fails on XYZE, and on damaged
/// ones before memory is taken.
Result<FloatImage> decodeRadiance(std::span<const std::uint8_t> bytes, const std::string& where,
                                  std::vector<std::string>& warnings);

/// $XDG_CACHE_HOME/weft, or ~/.cache/weft; empty where neither is set.
std::filesystem::path cacheFolder();

/// The built-in environment of a name, or else that of a file.
Result<Environment> environmentNamed(const std::string& nameOrFile, std::vector<std::string>& warnings);

/// PrefilteredEnvironment::create(), or its result of an earlier run from `folder`, where it is
/// kept under a hash of the environment's values and of how they are filtered. A file that is not
/// as it was written is made anew, with a line in `warnings`; one that cannot be written changes
/// nothing but the time. An empty folder keeps nothing.
PrefilteredEnvironment prefilter(const Environment& environment, const std::filesystem::path& folder,
                                 std::vector<std::string>& warnings);

}  // namespace weft
