#pragma once

#include <map>
#include <memory>

#include "GltfFile.h"
#include "weft/core/Image.h"
#include "weft/scene_io/GltfLoader.h"

namespace weft {

/// Makes the materials of a file when they are first asked for, so that what nothing uses, or what the
/// options replace, may lack its files.
class GltfMaterials {
 public:
  /// All three must outlive this.
  GltfMaterials(const GltfFile& file, const GltfOptions& options, std::vector<std::string>& warnings)
      : file_(file), options_(options), warnings_(warnings) {}

  /// `index` -1: glTF's default material.
  Result<std::shared_ptr<const Material>> get(int index);
  /// Of all that get() was asked for.
  std::vector<std::string> names() const;

 private:
  struct Named {
    std::string name;
    std::shared_ptr<const Material> material;
  };

  Result<std::shared_ptr<const Material>> make(const tinygltf::Material& material);
  Result<std::shared_ptr<const Material>> makeBtf(const tinygltf::Material& material);
  Result<std::shared_ptr<const Material>> makeLambert(const tinygltf::Material& material);
  Result<std::shared_ptr<const Image>> baseColor(const tinygltf::Material& material);

  const GltfFile& file_;
  const GltfOptions& options_;
  std::vector<std::string>& warnings_;
  std::map<int, Named> made_;
  std::map<int, std::shared_ptr<const Image>> images_;
};

}  // namespace weft
