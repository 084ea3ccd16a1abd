#include "GltfPbr.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "GltfExtension.h"
#include "GltfLayers.h"
#include "GltfPlacement.h"

namespace weft {
namespace {

constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr float kInfiniteRefractiveIndex = 1e6f;  // mirrors everything

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
  options.baseColor = {unitFactor(color[0]), unitFactor(color[1]), unitFactor(color[2]),
                       unitFactor(color[3])};
  options.metallic = unitFactor(pbr.metallicFactor);
  options.roughness = unitFactor(pbr.roughnessFactor);
  options.emission = {unitFactor(emission[0]), unitFactor(emission[1]), unitFactor(emission[2])};
  options.normalScale = static_cast<float>(material.normalTexture.scale);
  options.occlusionStrength = unitFactor(material.occlusionTexture.strength);
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
  const std::string of = "of " + quoted(material);
  const auto forOne = [&](const char* name, const auto& read) -> Result<void> {
    const auto found = material.extensions.find(name);
    if (found == material.extensions.end()) return {};
    return read(GltfExtension(file_, textures_, name, found->second, of));
  };
  WEFT_TRY_VOID(
      forOne("KHR_materials_emissive_strength", [&](const GltfExtension& extension) -> Result<void> {
        WEFT_TRY(const double strength, extension.number("emissiveStrength", 1.0));
        options.emission *= static_cast<float>(std::max(strength, 0.0));
        return {};
      }));
  WEFT_TRY_VOID(forOne("KHR_materials_ior", [&](const GltfExtension& extension) -> Result<void> {
    WEFT_TRY(const double ior, extension.number("ior", 1.5));
    // 0 stands for an infinite one.
    options.refractiveIndex = ior == 0.0 ? kInfiniteRefractiveIndex : static_cast<float>(std::max(ior, 1.0));
    return {};
  }));
  WEFT_TRY_VOID(forOne("KHR_materials_specular",
                       [&](const auto& extension) { return readSpecular(extension, options); }));
  WEFT_TRY_VOID(forOne(kSpecularGlossiness, [&](const auto& extension) {
    return readSpecularGlossiness(extension, of, options);
  }));
  WEFT_TRY_VOID(readLayers(file_, textures_, material, of, options));
  if (material.extensions.contains("KHR_materials_unlit")) {
    options.unlit = true;
    options.emission = glm::vec3(0.0f);
  }
  return {};
}

Result<void> GltfPbr::readSpecular(const GltfExtension& extension, PBROptions& options) {
  WEFT_TRY(options.specular, extension.factor("specularFactor", 1.0));
  WEFT_TRY(options.specularColor, extension.color("specularColorFactor", 1.0));
  WEFT_TRY(options.specularTexture, extension.texture("specularTexture", false, "specular"));
  WEFT_TRY(options.specularColorTexture, extension.texture("specularColorTexture", true, "specular colour"));
  return {};
}

/// The same surface in other words: a dielectric that mirrors all, times the colour of its
/// highlights.
Result<void> GltfPbr::readSpecularGlossiness(const GltfExtension& extension, const std::string& of,
                                             PBROptions& options) {
  constexpr const char* kTexture = "specularGlossinessTexture";
  WEFT_TRY(const std::vector<double> diffuse,
           numbersOf(file_, kSpecularGlossiness, extension.value(), "diffuseFactor", {1.0, 1.0, 1.0, 1.0}));
  WEFT_TRY(const glm::vec3 specular, extension.color("specularFactor", 1.0));
  WEFT_TRY(const float glossiness, extension.factor("glossinessFactor", 1.0));
  for (int channel = 0; channel < 4; ++channel)
    options.baseColor[channel] = unitFactor(diffuse[static_cast<std::size_t>(channel)]);
  options.metallic = 0.0f;
  options.roughness = 1.0f - glossiness;
  options.refractiveIndex = kInfiniteRefractiveIndex;
  options.specular = 1.0f;
  options.specularColor = glm::min(specular, glm::vec3(1.0f));
  options.specularTexture = options.metallicRoughnessTexture = {};
  WEFT_TRY(options.baseColorTexture, extension.texture("diffuseTexture", true, "diffuse"));
  WEFT_TRY(options.specularColorTexture, extension.texture(kTexture, true, "specular-glossiness"));
  if (!extension.has(kTexture)) return {};
  if (!options.specularColorTexture.image) {
    // Factors without their texture mean nothing: most things are matt.
    options.refractiveIndex = 1.5f;
    options.specularColor = glm::vec3(1.0f);
    options.roughness = 1.0f;
    return {};
  }
  const int index = extension.value().Get(kTexture).Get("index").GetNumberAsInt();
  WEFT_TRY(std::shared_ptr<const TextureChunk> roughness,
           textures_.roughnessOf(index, glossiness, "roughness " + of));
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

}  // namespace weft
