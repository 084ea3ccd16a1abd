#include "GltfMaterials.h"

#include <algorithm>
#include <cmath>

#include "weft/scene_io/BTFMaterialLoader.h"

namespace weft {
namespace {

constexpr const char* kBtfExtension = "WEFT_materials_btf";
constexpr const char* kPlacementExtension = "KHR_texture_transform";

std::string quoted(const tinygltf::Material& material) {
  return "material \"" + material.name + "\"";
}

/// Says what the missing or broken file is for.
tl::unexpected<Error> becauseOf(Error error, const GltfFile& file, const std::string& use) {
  const std::string hint = "it is the " + use + " of " + file.path.filename().string();
  error.hint = error.hint.empty() ? hint : hint + "; " + error.hint;
  return tl::unexpected<Error>(std::move(error));
}

glm::vec2 vec2From(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1]};
}

float unit(double factor) {
  return static_cast<float>(std::clamp(factor, 0.0, 1.0));
}

/// A set of texture coordinates; those of a file are numbered from 0.
Result<int> setFrom(const GltfFile& file, double number) {
  if (!(number >= 0.0 && number < 1000.0)) return file.fail("there is no such set of texture coordinates");
  return static_cast<int>(number);
}

/// How a texture with these extensions lies, `set` where they do not say another.
Result<TexturePlacement> placementFrom(const GltfFile& file, const tinygltf::ExtensionMap& extensions,
                                       int set) {
  TexturePlacement placement;
  WEFT_TRY(placement.set, setFrom(file, set));
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
  WEFT_TRY(placement.set, setFrom(file, texCoord[0]));
  return placement;
}

/// The set that the file's tangents belong to: the normal texture's.
Result<int> tangentSetOf(const GltfFile& file, const tinygltf::Material& material) {
  WEFT_TRY(const TexturePlacement placement,
           placementFrom(file, material.normalTexture.extensions, material.normalTexture.texCoord));
  return placement.set;
}

Result<glm::vec2> btfScale(const GltfFile& file, const tinygltf::Value& extension) {
  WEFT_TRY(const std::vector<double> scale, numbersOf(file, kBtfExtension, extension, "scale", {1.0, 1.0}));
  const glm::vec2 value = vec2From(scale);
  // A negative one would mirror the image, but not the directions that its relief was measured in.
  if (!(value.x > 0.0f && value.y > 0.0f))
    return file.fail(std::string("the scale of ") + kBtfExtension + " is not positive");
  return value;
}

}  // namespace

Result<MeshDress> GltfMaterials::get(int index, Shading shading) {
  if (const auto found = made_.find({index, shading}); found != made_.end()) return found->second;
  if (index < -1 || index >= static_cast<int>(file_.model.materials.size()))
    return file_.fail("material " + std::to_string(index) + " does not exist");
  const tinygltf::Material material =
      index < 0 ? tinygltf::Material() : file_.model.materials[static_cast<std::size_t>(index)];
  WEFT_TRY(MeshDress dress, make(index, material, shading));
  WEFT_TRY(dress.tangentSet, tangentSetOf(file_, material));
  return made_[{index, shading}] = std::move(dress);
}

std::vector<std::string> GltfMaterials::names() const {
  std::vector<std::string> names;
  int last = -2;
  for (const auto& [key, dress] : made_) {
    const int index = key.first;
    if (index != last)
      names.push_back(index < 0 ? "" : file_.model.materials[static_cast<std::size_t>(index)].name);
    last = index;
  }
  return names;
}

Result<MeshDress> GltfMaterials::make(int index, const tinygltf::Material& material, Shading shading) {
  auto replacement = options_.replacements.find(material.name);
  if (replacement == options_.replacements.end()) replacement = options_.replacements.find("*");
  if (replacement != options_.replacements.end())
    return MeshDress{.material = replacement->second, .usesTexcoords = true};
  if (options_.makeMaterial && index >= 0) {
    GltfMaterial source{file_.path, material.name, {}};
    if (const auto& texts = file_.contents.materials; static_cast<std::size_t>(index) < texts.size())
      source.json = texts[static_cast<std::size_t>(index)];
    WEFT_TRY(std::shared_ptr<const Material> made, options_.makeMaterial(source));
    if (made) return MeshDress{.material = std::move(made), .usesTexcoords = true};
  }
  return material.extensions.contains(kBtfExtension) ? makeBtf(material) : makePbr(material, shading);
}

Result<MeshDress> GltfMaterials::makeBtf(const tinygltf::Material& material) {
  const tinygltf::Value& extension = material.extensions.at(kBtfExtension);
  if (!extension.IsObject() || !extension.Get("uri").IsString())
    return file_.fail(quoted(material) + " has " + kBtfExtension + " without a uri");
  WEFT_TRY(const glm::vec2 scale, btfScale(file_, extension));
  WEFT_TRY(const std::vector<double> set, numbersOf(file_, kBtfExtension, extension, "texCoord", {0.0}));
  MeshDress dress{.usesTexcoords = true};
  tinygltf::ExtensionMap nested;
  if (extension.Get("extensions").IsObject() && extension.Get("extensions").Has(kPlacementExtension))
    nested[kPlacementExtension] = extension.Get("extensions").Get(kPlacementExtension);
  WEFT_TRY(const int plainSet, setFrom(file_, set[0]));
  WEFT_TRY(dress.placement, placementFrom(file_, nested, plainSet));
  dress.sets = {dress.placement.set, dress.placement.set == 0 ? 1 : 0};
  BTFMaterialOptions options = options_.btf;
  options.textureScale *= scale;
  options.doubleSided |= material.doubleSided;
  auto made = loadBTFMaterial(resolve(file_, extension.Get("uri").Get<std::string>()), options);
  if (!made) return becauseOf(std::move(made).error(), file_, "reflectance field of " + quoted(material));
  dress.material = std::move(*made);
  return dress;
}

Result<MeshDress> GltfMaterials::makePbr(const tinygltf::Material& material, Shading shading) {
  PBROptions options;
  WEFT_TRY_VOID(readFactors(material, options));
  WEFT_TRY_VOID(readAlpha(material, options));
  WEFT_TRY_VOID(readTextures(material, options));
  WEFT_TRY_VOID(readExtensions(material, options));
  options.doubleSided = material.doubleSided;
  if (shading != Shading::Full) options.normalTexture = {};
  if (shading == Shading::Unlit) options.unlit = true;

  // The normal texture's set comes first, because the tangents of a mesh belong to its first one.
  MeshDress dress;
  std::vector<int> sets;
  for (PBRTexture* texture :
       {&options.normalTexture, &options.baseColorTexture, &options.metallicRoughnessTexture,
        &options.emissionTexture, &options.occlusionTexture}) {
    if (!texture->image) continue;
    int& set = texture->placement.set;
    auto found = std::find(sets.begin(), sets.end(), set);
    if (found == sets.end()) found = sets.insert(sets.end(), set);
    set = static_cast<int>(found - sets.begin());
    dress.usesTexcoords = true;
    if (set < 2) continue;
    warnings_.push_back(quoted(material) +
                        " uses more than two sets of texture coordinates; a texture is "
                        "shown with another's");
    set = 0;
  }
  if (!sets.empty()) dress.sets = {sets[0], sets.size() > 1 ? sets[1] : sets[0] == 0 ? 1 : 0};
  dress.material = std::make_shared<const PBRMaterial>(options);
  return dress;
}

Result<void> GltfMaterials::readFactors(const tinygltf::Material& material, PBROptions& options) const {
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

Result<void> GltfMaterials::readAlpha(const tinygltf::Material& material, PBROptions& options) const {
  if (material.alphaMode == "MASK")
    options.alphaMode = AlphaMode::Mask;
  else if (material.alphaMode == "BLEND")
    options.alphaMode = AlphaMode::Blend;
  else if (material.alphaMode != "OPAQUE")
    return file_.fail(quoted(material) + " has an alphaMode that glTF does not know: " + material.alphaMode);
  options.alphaCutoff = static_cast<float>(material.alphaCutoff);
  return {};
}

Result<void> GltfMaterials::readTextures(const tinygltf::Material& material, PBROptions& options) {
  const std::string of = " of " + quoted(material);
  const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
  WEFT_TRY(options.baseColorTexture, texture(pbr.baseColorTexture, true, "base colour" + of));
  WEFT_TRY(options.metallicRoughnessTexture,
           texture(pbr.metallicRoughnessTexture, false, "metallic-roughness texture" + of));
  WEFT_TRY(options.normalTexture, texture(material.normalTexture, false, "normal texture" + of));
  WEFT_TRY(options.occlusionTexture, texture(material.occlusionTexture, false, "occlusion texture" + of));
  WEFT_TRY(options.emissionTexture, texture(material.emissiveTexture, true, "emissive texture" + of));
  // The factors of a texture that is not there mean nothing: most things are no metal, and do not glow.
  if (pbr.metallicRoughnessTexture.index >= 0 && !options.metallicRoughnessTexture.image)
    options.metallic = 0.0f;
  if (material.emissiveTexture.index >= 0 && !options.emissionTexture.image) options.emission = glm::vec3(0);
  return {};
}

Result<void> GltfMaterials::readExtensions(const tinygltf::Material& material, PBROptions& options) {
  const auto number = [&](const char* extension, const char* key, double otherwise) -> Result<double> {
    const auto found = material.extensions.find(extension);
    if (found == material.extensions.end()) return otherwise;
    WEFT_TRY(const std::vector<double> numbers, numbersOf(file_, extension, found->second, key, {otherwise}));
    return numbers[0];
  };
  WEFT_TRY(const double strength, number("KHR_materials_emissive_strength", "emissiveStrength", 1.0));
  WEFT_TRY(const double ior, number("KHR_materials_ior", "ior", 1.5));
  WEFT_TRY(const double specular, number("KHR_materials_specular", "specularFactor", 1.0));
  options.emission *= static_cast<float>(std::max(strength, 0.0));
  // 0 stands for an infinite one, which mirrors everything.
  options.refractiveIndex = ior == 0.0 ? 1e6f : static_cast<float>(std::max(ior, 1.0));
  options.specular = unit(specular);
  if (const auto found = material.extensions.find("KHR_materials_specular");
      found != material.extensions.end()) {
    WEFT_TRY(const std::vector<double> color,
             numbersOf(file_, found->first, found->second, "specularColorFactor", {1.0, 1.0, 1.0}));
    for (int channel = 0; channel < 3; ++channel)
      options.specularColor[channel] =
          static_cast<float>(std::max(color[static_cast<std::size_t>(channel)], 0.0));
    if (found->second.Has("specularTexture") || found->second.Has("specularColorTexture"))
      warnings_.push_back(quoted(material) + " is shown without the textures of KHR_materials_specular");
  }
  if (material.extensions.contains("KHR_materials_unlit")) {
    options.unlit = true;
    options.emission = glm::vec3(0.0f);
  }
  return {};
}

template <class Info>
Result<PBRTexture> GltfMaterials::texture(const Info& info, bool srgb, const std::string& use) {
  if (info.index < 0) return PBRTexture{};
  PBRTexture made;
  WEFT_TRY(made.placement, placementFrom(file_, info.extensions, info.texCoord));
  WEFT_TRY(made.image, textures_.get(info.index, srgb, use));
  return made;
}

}  // namespace weft
