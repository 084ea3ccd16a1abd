#include "GltfTextures.h"

#include <fmt/format.h>

#include <cmath>

#include "GltfReference.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

TextureWrap wrapOf(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return TextureWrap::Clamp;
  return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? TextureWrap::Mirror : TextureWrap::Repeat;
}

/// glTF leaves the filters to the program where the file names none; of the four kinds of mipmaps
/// Weft has the best.
TextureOptions optionsOf(const tinygltf::Sampler& sampler) {
  TextureOptions options{
      .filter = TextureFilter::Mipmapped, .wrap = wrapOf(sampler.wrapS), .wrapV = wrapOf(sampler.wrapT)};
  if (sampler.minFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) options.filter = TextureFilter::Nearest;
  if (sampler.minFilter == TINYGLTF_TEXTURE_FILTER_LINEAR) options.filter = TextureFilter::Linear;
  options.magnification =
      sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST ? TextureFilter::Nearest : TextureFilter::Linear;
  return options;
}

/// Equal for textures that look the same.
std::string keyOf(const void* pixels, const TextureOptions& options) {
  return fmt::format("{} {} {} {} {} {}", pixels, int(options.filter), int(*options.magnification),
                     int(options.wrap), int(*options.wrapV), options.srgb);
}

/// Two channels, the second of which is the roughness.
Image roughnessFrom(const Image& image, float factor) {
  Image roughness(image.width, image.height, 2);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < roughness.bytes.size() / 2; ++i) {
    const float glossiness = factor * static_cast<float>(image.bytes[i * channels + channels - 1]);
    roughness.bytes[2 * i + 1] = static_cast<std::uint8_t>(std::lround(255.0f - glossiness));
  }
  return roughness;
}

bool isOpaqueImage(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  if (channels % 2 != 0) return true;
  for (std::size_t alpha = channels - 1; alpha < image.bytes.size(); alpha += channels)
    if (image.bytes[alpha] != 255) return false;
  return true;
}

}  // namespace

Result<GltfTextures::Source> GltfTextures::sourceOf(int index, const std::string& use) {
  if (index < 0 || static_cast<std::size_t>(index) >= file_.model.textures.size())
    return file_.fail("texture " + std::to_string(index) + " does not exist");
  const tinygltf::Texture& texture = file_.model.textures[static_cast<std::size_t>(index)];
  tinygltf::Sampler sampler;
  if (texture.sampler >= 0) {
    if (static_cast<std::size_t>(texture.sampler) >= file_.model.samplers.size())
      return file_.fail("sampler " + std::to_string(texture.sampler) + " does not exist");
    sampler = file_.model.samplers[static_cast<std::size_t>(texture.sampler)];
  }
  WEFT_TRY(Pixels pixels, image(texture.source, texture, use));
  return Source{std::move(pixels), optionsOf(sampler)};
}

Result<std::shared_ptr<const TextureChunk>> GltfTextures::get(int index, bool srgb, const std::string& use) {
  if (const auto found = chunks_.find({index, srgb}); found != chunks_.end()) return found->second;
  WEFT_TRY(Source source, sourceOf(index, use));
  source.options.srgb = srgb;
  const bool isWide = source.pixels.wide && !srgb;
  const void* pixels = source.pixels.image.get();
  if (isWide) pixels = source.pixels.wide.get();
  std::shared_ptr<const TextureChunk>& chunk = shared_[keyOf(pixels, source.options)];
  if (chunk) return chunks_[{index, srgb}] = chunk;
  if (isWide)
    chunk = std::make_shared<const TextureChunk>(std::move(source.pixels.wide), source.options);
  else if (source.pixels.image)
    chunk = std::make_shared<const TextureChunk>(std::move(source.pixels.image), source.options);
  return chunks_[{index, srgb}] = chunk;
}

bool GltfTextures::isOpaque(const TextureChunk& made) const {
  for (const auto& [key, chunk] : chunks_) {
    if (chunk.get() != &made) continue;
    const int source = file_.model.textures[static_cast<std::size_t>(key.first)].source;
    return isOpaqueImage(*images_.at(source).image);
  }
  return false;
}

Result<std::shared_ptr<const TextureChunk>> GltfTextures::roughnessOf(int index, float factor,
                                                                      const std::string& use) {
  if (const auto found = roughness_.find({index, factor}); found != roughness_.end()) return found->second;
  WEFT_TRY(const Source source, sourceOf(index, use));
  std::shared_ptr<const TextureChunk>& chunk = roughness_[{index, factor}];
  const Image* glossiness = source.pixels.image.get();
  if (!glossiness || glossiness->channels % 2 != 0) return chunk;
  convertedBytes_ += glossiness->bytes.size();
  // One image may be converted for any number of factors.
  if (convertedBytes_ > decodedBytes_ + file_.memoryLimit) {
    warnings_.push_back("the " + use + " is left out: it takes too much memory for a file of this size");
    return chunk;
  }
  auto image = std::make_shared<const Image>(roughnessFrom(*glossiness, factor));
  return chunk = std::make_shared<const TextureChunk>(std::move(image), source.options);
}

Result<GltfTextures::Pixels> GltfTextures::image(int index, const tinygltf::Texture& texture,
                                                 const std::string& use) {
  if (const auto found = images_.find(index); index >= 0 && found != images_.end()) return found->second;
  if (index < 0) {
    std::string extensions;
    for (const auto& [name, value] : texture.extensions)
      extensions += (extensions.empty() ? ": " : ", ") + name;
    warnings_.push_back("the " + use + " is left out: it has no image that Weft reads" + extensions);
    return Pixels();
  }
  if (static_cast<std::size_t>(index) >= file_.model.images.size())
    return file_.fail("image " + std::to_string(index) + " does not exist");
  Pixels& kept = images_[index];
  if (Result<Pixels> pixels = decoded(index))
    kept = std::move(*pixels);
  else
    warnings_.push_back("the " + use + " is left out: " + pixels.error().message());
  return kept;
}

Result<GltfTextures::Pixels> GltfTextures::decoded(int index) {
  WEFT_TRY(const Origin origin, originOf(index));
  Pixels& known = decoded_[origin.key];
  if (known.image) return known;
  WEFT_TRY(const std::vector<std::uint8_t> bytes, imageBytes(file_, index));
  WEFT_TRY(Image image, decodeImage(bytes, origin.where));
  decodedBytes_ += image.bytes.size();
  if (isWideImage(bytes)) {
    WEFT_TRY(WideImage wide, decodeWideImage(bytes, origin.where));
    decodedBytes_ += wide.words.size() * sizeof(std::uint16_t);
    known.wide = std::make_shared<const WideImage>(std::move(wide));
  }
  known.image = std::make_shared<const Image>(std::move(image));
  return known;
}

Result<GltfTextures::Origin> GltfTextures::originOf(int index) const {
  const tinygltf::Image& image = file_.model.images[static_cast<std::size_t>(index)];
  const std::string number = std::to_string(index), embedded = file_.path.string() + ", image " + number;
  if (image.bufferView >= 0) {
    WEFT_TRY(const std::span<const std::uint8_t> bytes, viewBytes(file_, image.bufferView));
    return Origin{fmt::format("{} {}", fmt::ptr(bytes.data()), bytes.size()), embedded};
  }
  if (isDataUri(image.uri)) return Origin{number, embedded + " (" + shownUri(image.uri) + ")"};
  WEFT_TRY(const std::filesystem::path path, resolveUri(file_.path, image.uri));
  return Origin{path.lexically_normal().string(), path.string()};
}

}  // namespace weft
