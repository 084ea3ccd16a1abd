#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// Larger files are refused before memory is taken: glTF, and its buffers.
constexpr std::size_t kLargestGltfFile = std::size_t{1} << 31;

/// Whether a uri holds its bytes itself.
bool isDataUri(std::string_view uri);

/// A uri for people: of one that holds its bytes only the start, and how long it is.
std::string shownUri(std::string_view uri);

/// The file that a uri names, by the one rule for buffers, images and fields (docs/gltf.md);
/// `file`: the glTF, for whose folder it is. It need not exist. Fails where the uri names no file.
Result<std::filesystem::path> resolveUri(const std::filesystem::path& file, const std::string& uri);

/// The bytes of a uri, its own or those of its file, which is not larger than `limit`.
Result<std::vector<std::uint8_t>> readUri(const std::filesystem::path& file, const std::string& uri,
                                          std::size_t limit);

}  // namespace weft
