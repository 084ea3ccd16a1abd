#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "GltfData.h"
#include "weft/core/Result.h"

namespace weft {

/// A glTF file as tinygltf parsed it, with the checks that tinygltf leaves out: whatever the functions below
/// hand out lies within the file.
struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model model;
  GltfContents contents;
  std::string warning;  ///< of tinygltf, about what it left out; may be empty

  std::filesystem::path folder() const { return path.parent_path(); }
  /// Fails with this file as the place.
  tl::unexpected<Error> fail(std::string what, std::string hint = {}) const {
    return weft::fail(std::move(what), path.string(), std::move(hint));
  }
};

/// The bytes of a .gltf or .glb, and the JSON among them: all, or the first chunk of a .glb, told by the
/// first bytes. Fails on a broken header, and on JSON nested so deeply that parsers, which recurse, would not
/// survive it.
Result<std::vector<std::uint8_t>> readGltfBytes(const std::filesystem::path& path);
Result<std::string_view> jsonOf(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path);

/// Reads .gltf (with its buffers) or .glb, told by the first bytes; it may require the extensions that Weft
/// or the options know. Images are left alone: see imageBytes().
Result<GltfFile> readGltfFile(const std::filesystem::path& path, const GltfOptions& options);

/// The bytes of a buffer view.
Result<std::span<const std::uint8_t>> viewBytes(const GltfFile& file, int view);

/// A member of an extension that is as many numbers as `otherwise`, which it is where the member is missing;
/// a single one need not be an array. Fails where it is something else, or not finite as a float.
Result<std::vector<double>> numbersOf(const GltfFile& file, const std::string& extension,
                                      const tinygltf::Value& value, const std::string& key,
                                      const std::vector<double>& otherwise);

/// The encoded bytes of an image (PNG or JPEG), embedded or from its file.
Result<std::vector<std::uint8_t>> imageBytes(const GltfFile& file, int image);

/// Resolves the %20 of a relative reference in the file against its folder.
std::filesystem::path resolve(const GltfFile& file, const std::string& uri);

}  // namespace weft
