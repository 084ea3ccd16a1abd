#pragma once

#include "GltfExtension.h"
#include "GltfFile.h"
#include "GltfTextures.h"
#include "weft/materials/PBRMaterial.h"

namespace weft {

/// A material's name, for people.
std::string quoted(const tinygltf::Material& material);

/// Reads what a material says in glTF's own terms and those of Khronos' extensions.
class GltfPbr {
 public:
  /// All must outlive this.
  GltfPbr(const GltfFile& file, GltfTextures& textures) : file_(file), textures_(textures) {}

  /// The sets of texture coordinates of its textures are the file's.
  Result<PBROptions> read(const tinygltf::Material& material);

 private:
  Result<void> readFactors(const tinygltf::Material& material, PBROptions& options) const;
  Result<void> readAlpha(const tinygltf::Material& material, PBROptions& options) const;
  Result<void> readTextures(const tinygltf::Material& material, PBROptions& options);
  Result<void> readExtensions(const tinygltf::Material& material, PBROptions& options);
  static Result<void> readSpecular(const GltfExtension& extension, PBROptions& options);
  Result<void> readSpecularGlossiness(const GltfExtension& extension, const std::string& of,
                                      PBROptions& options);
  /// `info`: any of tinygltf's kinds.
  template <class Info>
  Result<PBRTexture> texture(const Info& info, bool srgb, const std::string& use);

  const GltfFile& file_;
  GltfTextures& textures_;
};

}  // namespace weft
