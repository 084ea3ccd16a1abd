#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "GltfData.h"
#include "TinyGltf.h"
#include "weft/core/Result.h"

namespace weft {

/// The bytes of a buffer; several may lie in one file.
struct GltfBuffer {
  std::shared_ptr<const std::vector<std::uint8_t>> owner{};
  std::span<const std::uint8_t> bytes{};
};

/// A glTF file as tinygltf parsed it, with the checks that tinygltf leaves out: whatever the
/// functions below hand out lies within the file.
struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model model;  ///< but for what is in its buffers and images
  std::vector<GltfBuffer> buffers;
  GltfContents contents;
  std::vector<std::string> warnings;              ///< about what was left out
  std::vector<std::filesystem::path> namedFiles;  ///< all that its uris name, there or not
  /// So many bytes may be made of it: what a file claims without bytes of its own (zeros, sparse
  /// values, one accessor in many meshes) must not take more memory than files of its size need.
  std::size_t memoryLimit = 0;

  /// Fails with this file as the place.
  tl::unexpected<Error> fail(std::string what, std::string hint = {}) const {
    return weft::fail(std::move(what), path.string(), std::move(hint));
  }
  /// Fails where something takes more bytes than the limit.
  Result<void> checkMemory(std::size_t bytes, const std::string& what) const;
  /// The number of a new buffer of these bytes.
  int addBuffer(std::vector<std::uint8_t> bytes);
};

/// Reads .gltf (with its buffers) or .glb, told by the first bytes; it may require the extensions
/// that Weft or the options know. Images are left alone: see imageBytes().
Result<GltfFile> readGltfFile(const std::filesystem::path& path, const GltfOptions& options);

/// The bytes of a buffer view.
Result<std::span<const std::uint8_t>> viewBytes(const GltfFile& file, int view);

/// Bytes of a buffer; `name`: of what has them, for people.
Result<std::span<const std::uint8_t>> bytesIn(const GltfFile& file, int buffer, std::size_t offset,
                                              std::size_t length, const std::string& name);

/// A member of an extension that is as many numbers as `otherwise`, which it is where the member is
/// missing; a single one need not be an array. Fails where it is something else, or not finite as a
/// float.
Result<std::vector<double>> numbersOf(const GltfFile& file, const std::string& extension,
                                      const tinygltf::Value& value, const std::string& key,
                                      const std::vector<double>& otherwise);

/// The encoded bytes of an image (PNG or JPEG), embedded or from its file.
Result<std::vector<std::uint8_t>> imageBytes(const GltfFile& file, int image);

}  // namespace weft
