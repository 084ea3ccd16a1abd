#include "GltfPlacement.h"

namespace weft {
namespace {

constexpr const char* kPlacementExtension = "KHR_texture_transform";

glm::vec2 vec2From(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1]};
}

}  // namespace

Result<int> texcoordSetFrom(const GltfFile& file, double number) {
  if (!(number >= 0.0 && number < 1000.0)) return file.fail("there is no such set of texture coordinates");
  return static_cast<int>(number);
}

Result<TexturePlacement> placementFrom(const GltfFile& file, const tinygltf::ExtensionMap& extensions,
                                       int set) {
  TexturePlacement placement;
  WEFT_TRY(placement.set, texcoordSetFrom(file, set));
  const auto found = extensions.find(kPlacementExtension);
  if (found == extensions.end()) return placement;
  const auto numbers = [&](const char* key, const std::vector<double>& otherwise) {
    return numbersOf(file, kPlacementExtension, found->second, key, otherwise);
  };
  WEFT_TRY(const std::vector<double> scale, numbers("scale", {1.0, 1.0}));
  WEFT_TRY(const std::vector<double> rotation, numbers("rotation", {0.0}));
  WEFT_TRY(const std::vector<double> offset, numbers("offset", {0.0, 0.0}));
  WEFT_TRY(const std::vector<double> texCoord, numbers("texCoord", {double(placement.set)}));
  placement.scale = vec2From(scale);
  placement.rotation = static_cast<float>(rotation[0]);
  placement.offset = vec2From(offset);
  WEFT_TRY(placement.set, texcoordSetFrom(file, texCoord[0]));
  return placement;
}

tinygltf::ExtensionMap placementExtensionsOf(const tinygltf::Value& texture) {
  tinygltf::ExtensionMap extensions;
  if (!texture.Has("extensions") || !texture.Get("extensions").Has(kPlacementExtension)) return extensions;
  extensions[kPlacementExtension] = texture.Get("extensions").Get(kPlacementExtension);
  return extensions;
}

}  // namespace weft
