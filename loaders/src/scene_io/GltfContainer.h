#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// What a .gltf or .glb consists of, told by the first bytes: its text, and the bytes that stand
/// beside it in a .glb. Both lie within the bytes of the file.
struct GltfContainer {
  std::string_view json;
  std::span<const std::uint8_t> binary{};
};

/// The bytes of a .gltf or .glb.
Result<std::vector<std::uint8_t>> readGltfBytes(const std::filesystem::path& path);

/// Fails on a broken header, on what is no glTF, and on JSON nested so deeply that parsers, which
/// recurse, would not survive it. `path` is for people.
Result<GltfContainer> containerOf(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path);

/// The JSON of a container.
Result<nlohmann::ordered_json> parseJson(const GltfContainer& container, const std::filesystem::path& path);

}  // namespace weft
