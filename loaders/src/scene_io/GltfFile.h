#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// A glTF file as tinygltf parsed it, with the checks that tinygltf leaves out: whatever the functions below
/// hand out lies within the file.
struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model model;

  std::filesystem::path folder() const { return path.parent_path(); }
  /// Fails with this file as the place.
  tl::unexpected<Error> fail(std::string what, std::string hint = {}) const {
    return weft::fail(std::move(what), path.string(), std::move(hint));
  }
};

/// Reads .gltf (with its buffers) or .glb, told by the first bytes. Images are left alone: see imageBytes().
Result<GltfFile> readGltfFile(const std::filesystem::path& path);

/// The bytes of a buffer view.
Result<std::span<const std::uint8_t>> viewBytes(const GltfFile& file, int view);

/// An accessor as floats, `components` an element; integers are normalised where the file says so. Refuses
/// values that are not finite.
Result<std::vector<float>> readFloats(const GltfFile& file, int accessor, std::size_t components);

/// An accessor of whole numbers: vertex indices.
Result<std::vector<std::uint32_t>> readIndices(const GltfFile& file, int accessor);

/// The encoded bytes of an image (PNG or JPEG), embedded or from its file.
Result<std::vector<std::uint8_t>> imageBytes(const GltfFile& file, int image);

/// Resolves the %20 of a relative reference in the file against its folder.
std::filesystem::path resolve(const GltfFile& file, const std::string& uri);

}  // namespace weft
