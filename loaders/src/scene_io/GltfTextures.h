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

  /// Null, with one warning for all its uses, where the image is missing or broken; fails where the
  /// file's own references are. `use` is for people.
  Result<std::shared_ptr<const TextureChunk>> get(int texture, bool srgb, const std::string& use);
  /// The roughness, in g, that a texture with a glossiness in its alpha says: 1 - `factor` * alpha.
  /// Null where it has no alpha, and like get().
  Result<std::shared_ptr<const TextureChunk>> roughnessOf(int texture, float factor, const std::string& use);
  /// Whether every texel of a texture that get() made hides what is behind it.
  bool isOpaque(const TextureChunk& made) const;

 private:
  /// An image, and where its file has 16 bits, all of them, which colours need not.
  struct Pixels {
    std::shared_ptr<const Image> image;
    std::shared_ptr<const WideImage> wide;
  };
  /// What a texture shows, and how.
  struct Source {
    Pixels pixels;
    TextureOptions options;
  };

  Result<Source> sourceOf(int texture, const std::string& use);
  Result<Pixels> image(int index, const tinygltf::Texture& texture, const std::string& use);
  /// Where the bytes of an image are.
  struct Origin {
    /// equal for images that are the same bytes: a file may list one many times
    std::string key;
    std::string where;  ///< for people
  };
  Result<Origin> originOf(int image) const;
  Result<Pixels> decoded(int image);

  const GltfFile& file_;
  std::vector<std::string>& warnings_;
  std::map<int, Pixels> images_;
  std::map<std::string, Pixels> decoded_;  ///< by Origin::key
  std::map<std::pair<int, bool>, std::shared_ptr<const TextureChunk>> chunks_;
  std::map<std::string, std::shared_ptr<const TextureChunk>> shared_;  ///< by what they look like
  std::map<std::pair<int, float>, std::shared_ptr<const TextureChunk>> roughness_;
  std::size_t decodedBytes_ = 0;
  std::size_t convertedBytes_ = 0;
};

}  // namespace weft
