#pragma once

#include <map>
#include <memory>
#include <utility>

#include "GltfFile.h"
#include "weft/chunks/TextureChunk.h"

namespace weft {

/// The textures of a file, each made once, when it is first asked for.
class GltfTextures {
 public:
  /// Both must outlive this.
  GltfTextures(const GltfFile& file, std::vector<std::string>& warnings) : file_(file), warnings_(warnings) {}

  /// Null, with one warning for all its uses, where the image is missing or broken; fails where the file's
  /// own references are. `use` is for people.
  Result<std::shared_ptr<const TextureChunk>> get(int texture, bool srgb, const std::string& use);

 private:
  Result<std::shared_ptr<const Image>> image(int index, const std::string& use);

  const GltfFile& file_;
  std::vector<std::string>& warnings_;
  std::map<int, std::shared_ptr<const Image>> images_;
  std::map<std::pair<int, bool>, std::shared_ptr<const TextureChunk>> chunks_;
};

}  // namespace weft
