#include "GltfExtension.h"

#include "GltfPlacement.h"

namespace weft {

Result<double> GltfExtension::number(const char* key, double otherwise) const {
  WEFT_TRY(const std::vector<double> numbers, numbersOf(file_, name_, value_, key, {otherwise}));
  return numbers[0];
}

Result<float> GltfExtension::factor(const char* key, double otherwise) const {
  WEFT_TRY(const double value, number(key, otherwise));
  return unitFactor(value);
}

Result<glm::vec3> GltfExtension::color(const char* key, double otherwise) const {
  WEFT_TRY(const std::vector<double> numbers,
           numbersOf(file_, name_, value_, key, {otherwise, otherwise, otherwise}));
  return glm::vec3(std::max(numbers[0], 0.0), std::max(numbers[1], 0.0), std::max(numbers[2], 0.0));
}

Result<PBRTexture> GltfExtension::texture(const char* key, bool srgb, const std::string& what) const {
  PBRTexture made;
  if (!value_.Has(key)) return made;
  const tinygltf::Value& member = value_.Get(key);
  const int set = member.Has("texCoord") ? member.Get("texCoord").GetNumberAsInt() : 0;
  WEFT_TRY(made.placement, placementFrom(file_, placementExtensionsOf(member), set));
  WEFT_TRY(made.image,
           textures_.get(member.Get("index").GetNumberAsInt(), srgb, what + " texture " + material_));
  return made;
}

Result<void> GltfExtension::texturedFactor(const char* key, const char* textureKey, const std::string& what,
                                           float& value, PBRTexture& made) const {
  WEFT_TRY(value, factor(key, 0.0));
  if (value == 0.0f) return {};
  WEFT_TRY(made, texture(textureKey, false, what));
  if (value_.Has(textureKey) && !made.image) value = 0.0f;
  return {};
}

}  // namespace weft
