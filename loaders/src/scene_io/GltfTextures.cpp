#include "GltfTextures.h"

#include "weft/io/ImageFile.h"

namespace weft {
namespace {

TextureWrap wrapOf(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::Clamp;
  return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::Mirror : TextureWrap::Repeat;
}

/// glTF leaves the filters to the program where the file names none; of the four kinds of mipmaps Weft has
/// the best.
TextureOptions optionsOf(const tinygltf::Sampler& sampler, bool srgb) {
  TextureOptions options{.filter = TextureFilter::Mipmapped,
                         .wrap = wrapOf(sampler.wrapS),
                         .wrapV = wrapOf(sampler.wrapT),
                         .srgb = srgb};
  if (sampler.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) options.filter = TextureFilter::Nearest;
  if (sampler.minFilter == TINYGLTF_TEXTURE_FILTER_LINEAR) options.filter = TextureFilter::Linear;
  options.magnification =
      sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? TextureFilter::Nearest : TextureFilter::Linear;
  return options;
}

}  // namespace

Result<std::shared_ptr<const TextureChunk>> GltfTextures::get(int index, bool srgb, const std::string& use) {
  if (index < 0 || static_cast<std::size_t>(index) >= file_.model.textures.size())
    return file_.fail("texture " + std::to_string(index) + " does not exist");
  if (const auto found = chunks_.find({index, srgb}); found != chunks_.end()) return found->second;
  const tinygltf::Texture& texture = file_.model.textures[static_cast<std::size_t>(index)];
  tinygltf::Sampler sampler;
  if (texture.sampler >= 0) {
    if (static_cast<std::size_t>(texture.sampler) >= file_.model.samplers.size())
      return file_.fail("sampler " + std::to_string(texture.sampler) + " does not exist");
    sampler = file_.model.samplers[static_cast<std::size_t>(texture.sampler)];
  }
  WEFT_TRY(std::shared_ptr<const Image> pixels, image(texture.source, use));
  std::shared_ptr<const TextureChunk> chunk;
  if (pixels) chunk = std::make_shared<const TextureChunk>(std::move(pixels), optionsOf(sampler, srgb));
  return chunks_[{index, srgb}] = std::move(chunk);
}

Result<std::shared_ptr<const Image>> GltfTextures::image(int index, const std::string& use) {
  if (const auto found = images_.find(index); found != images_.end()) return found->second;
  std::shared_ptr<const Image>& kept = images_[index];
  if (index < 0) {
    // KHR_texture_basisu and others have a source of their own.
    warnings_.push_back("the " + use + " is left out: it has no image that Weft reads");
    return kept;
  }
  if (static_cast<std::size_t>(index) >= file_.model.images.size())
    return file_.fail("image " + std::to_string(index) + " does not exist");
  const std::string& uri = file_.model.images[static_cast<std::size_t>(index)].uri;
  const auto decoded = [&]() -> Result<Image> {
    WEFT_TRY(const std::vector<std::uint8_t> bytes, imageBytes(file_, index));
    return decodeImage(bytes, uri.empty() ? file_.path.string() : resolve(file_, uri).string());
  }();
  if (decoded)
    kept = std::make_shared<const Image>(*decoded);
  else
    warnings_.push_back("the " + use + " is left out: " + decoded.error().message());
  return kept;
}

}  // namespace weft
