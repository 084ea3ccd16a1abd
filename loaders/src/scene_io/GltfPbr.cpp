#include "GltfPbr.h"

#include <algorithm>
#include <cmath>

#include "GltfPlacement.h"

namespace weft {
namespace {

constexpr const char* kSpecular = "KHR_materials_specular";
constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr float kInfiniteRefractiveIndex = 1e6f;  // mirrors everything

float unit(double factor) {
  return static_cast<float>(std::clamp(factor, 0.0, 1.0));
}

glm::vec3 unitColor(const std::vector<double>& numbers) {
  return {unit(numbers[0]), unit(numbers[1]), unit(numbers[2])};
}

}  // namespace

std::string quoted(const tinygltf::Material& material) {
  return "material \"" + material.name + "\"";
}

Result<PBROptions> GltfPbr::read(const tinygltf::Material& material) {
  PBROptions options;
  options.doubleSided = material.doubleSided;
  WEFT_TRY_VOID(readFactors(material, options));
  WEFT_TRY_VOID(readAlpha(material, options));
  WEFT_TRY_VOID(readTextures(material, options));
  WEFT_TRY_VOID(readExtensions(material, options));
  return options;
}

Result<void> GltfPbr::readFactors(const tinygltf::Material& material, PBROptions& options) const {
  const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  const auto finite = [](const std::vector<double>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(),
                       [](double number) { return std::isfinite(static_cast<float>(number)); });
  };
  const std::vector<double>& color = pbr.baseColorFactor;
  if (color.size() != 4 || !finite(color))
    return file_.fail("the baseColorFactor of " + quoted(material) + " is not four numbers");
  // The default material's is empty.
  const std::vector<double> emission =
      material.emissiveFactor.empty() ? std::vector<double>(3) : material.emissiveFactor;
  if (emission.size() != 3 || !finite(emission) ||
      !finite({pbr.metallicFactor, pbr.roughnessFactor, material.normalTexture.scale,
               material.occlusionTexture.strength, material.alphaCutoff}))
    return file_.fail("a factor of " + quoted(material) + " is not finite");
  options.baseColor = {unit(color[0]), unit(color[1]), unit(color[2]), unit(color[3])};
  options.metallic = unit(pbr.metallicFactor);
  options.roughness = unit(pbr.roughnessFactor);
  options.emission = {unit(emission[0]), unit(emission[1]), unit(emission[2])};
  options.normalScale = static_cast<float>(material.normalTexture.scale);
  options.occlusionStrength = unit(material.occlusionTexture.strength);
  return {};
}

Result<void> GltfPbr::readAlpha(const tinygltf::Material& material, PBROptions& options) const {
  if (material.alphaMode == "MASK")
    options.alphaMode = AlphaMode::Mask;
  else if (material.alphaMode == "BLEND")
    options.alphaMode = AlphaMode::Blend;
  else if (material.alphaMode != "OPAQUE")
    return file_.fail(quoted(material) + " has an alphaMode that glTF does not know: " + material.alphaMode);
  options.alphaCutoff = static_cast<float>(material.alphaCutoff);
  return {};
}

Result<void> GltfPbr::readTextures(const tinygltf::Material& material, PBROptions& options) {
  const std::string of = " of " + quoted(material);
  const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  WEFT_TRY(options.baseColorTexture, texture(pbr.baseColorTexture, true, "base colour" + of));
  WEFT_TRY(options.metallicRoughnessTexture,
           texture(pbr.metallicRoughnessTexture, false, "metallic-roughness texture" + of));
  WEFT_TRY(options.normalTexture, texture(material.normalTexture, false, "normal texture" + of));
  WEFT_TRY(options.occlusionTexture, texture(material.occlusionTexture, false, "occlusion texture" + of));
  WEFT_TRY(options.emissionTexture, texture(material.emissiveTexture, true, "emissive texture" + of));
  // The factors of a texture that is not there mean nothing: most things are no metal, and do not
  // glow.
  if (pbr.metallicRoughnessTexture.index >= 0 && !options.metallicRoughnessTexture.image)
    options.metallic = 0.0f;
  if (material.emissiveTexture.index >= 0 && !options.emissionTexture.image) options.emission = glm::vec3(0);
  return {};
}

Result<void> GltfPbr::readExtensions(const tinygltf::Material& material, PBROptions& options) {
  const auto number = [&](const char* extension, const char* key, double otherwise) -> Result<double> {
    const auto found = material.extensions.find(extension);
    if (found == material.extensions.end()) return otherwise;
    WEFT_TRY(const std::vector<double> numbers, numbersOf(file_, extension, found->second, key, {otherwise}));
    return numbers[0];
  };
  WEFT_TRY(const double strength, number("KHR_materials_emissive_strength", "emissiveStrength", 1.0));
  WEFT_TRY(const double ior, number("KHR_materials_ior", "ior", 1.5));
  options.emission *= static_cast<float>(std::max(strength, 0.0));
  // 0 stands for an infinite one.
  options.refractiveIndex = ior == 0.0 ? kInfiniteRefractiveIndex : static_cast<float>(std::max(ior, 1.0));
  const std::string of = " of " + quoted(material);
  if (const auto found = material.extensions.find(kSpecular); found != material.extensions.end())
    WEFT_TRY_VOID(readSpecular(found->second, of, options));
  if (const auto found = material.extensions.find(kSpecularGlossiness); found != material.extensions.end())
    WEFT_TRY_VOID(readSpecularGlossiness(found->second, of, options));
  if (material.extensions.contains("KHR_materials_unlit")) {
    options.unlit = true;
    options.emission = glm::vec3(0.0f);
  }
  return {};
}

Result<void> GltfPbr::readSpecular(const tinygltf::Value& extension, const std::string& of,
                                   PBROptions& options) {
  WEFT_TRY(const std::vector<double> factor, numbersOf(file_, kSpecular, extension, "specularFactor", {1.0}));
  WEFT_TRY(const std::vector<double> color,
           numbersOf(file_, kSpecular, extension, "specularColorFactor", {1.0, 1.0, 1.0}));
  options.specular = unit(factor[0]);
  for (int channel = 0; channel < 3; ++channel)
    options.specularColor[channel] =
        static_cast<float>(std::max(color[static_cast<std::size_t>(channel)], 0.0));
  WEFT_TRY(options.specularTexture, texture(extension, "specularTexture", false, "specular texture" + of));
  WEFT_TRY(options.specularColorTexture,
           texture(extension, "specularColorTexture", true, "specular colour texture" + of));
  return {};
}

/// The same surface in other words: a dielectric that mirrors all, times the colour of its
/// highlights.
Result<void> GltfPbr::readSpecularGlossiness(const tinygltf::Value& extension, const std::string& of,
                                             PBROptions& options) {
  const auto numbers = [&](const char* key, const std::vector<double>& otherwise) {
    return numbersOf(file_, kSpecularGlossiness, extension, key, otherwise);
  };
  constexpr const char* kTexture = "specularGlossinessTexture";
  WEFT_TRY(const std::vector<double> diffuse, numbers("diffuseFactor", {1.0, 1.0, 1.0, 1.0}));
  WEFT_TRY(const std::vector<double> specular, numbers("specularFactor", {1.0, 1.0, 1.0}));
  WEFT_TRY(const std::vector<double> glossiness, numbers("glossinessFactor", {1.0}));
  options.baseColor = glm::vec4(unitColor(diffuse), unit(diffuse[3]));
  options.metallic = 0.0f;
  options.roughness = 1.0f - unit(glossiness[0]);
  options.refractiveIndex = kInfiniteRefractiveIndex;
  options.specular = 1.0f;
  options.specularColor = unitColor(specular);
  options.specularTexture = options.metallicRoughnessTexture = {};
  WEFT_TRY(options.baseColorTexture, texture(extension, "diffuseTexture", true, "diffuse texture" + of));
  WEFT_TRY(options.specularColorTexture,
           texture(extension, kTexture, true, "specular-glossiness texture" + of));
  if (!extension.Has(kTexture)) return {};
  if (!options.specularColorTexture.image) {
    // Factors without their texture mean nothing: most things are matt.
    options.refractiveIndex = 1.5f;
    options.specularColor = glm::vec3(1.0f);
    options.roughness = 1.0f;
    return {};
  }
  const int index = extension.Get(kTexture).Get("index").GetNumberAsInt();
  WEFT_TRY(std::shared_ptr<const TextureChunk> roughness,
           textures_.roughnessOf(index, unit(glossiness[0]), "roughness" + of));
  if (!roughness) return {};
  options.metallicRoughnessTexture = {std::move(roughness), options.specularColorTexture.placement};
  options.roughness = 1.0f;
  return {};
}

template <class Info>
Result<PBRTexture> GltfPbr::texture(const Info& info, bool srgb, const std::string& use) {
  if (info.index < 0) return PBRTexture{};
  PBRTexture made;
  WEFT_TRY(made.placement, placementFrom(file_, info.extensions, info.texCoord));
  WEFT_TRY(made.image, textures_.get(info.index, srgb, use));
  return made;
}

Result<PBRTexture> GltfPbr::texture(const tinygltf::Value& extension, const char* key, bool srgb,
                                    const std::string& use) {
  if (!extension.Has(key)) return PBRTexture{};
  const tinygltf::Value& member = extension.Get(key);
  tinygltf::TextureInfo info;
  info.index = member.Get("index").GetNumberAsInt();
  if (member.Has("texCoord")) info.texCoord = member.Get("texCoord").GetNumberAsInt();
  info.extensions = placementExtensionsOf(member);
  return texture(info, srgb, use);
}

}  // namespace weft
