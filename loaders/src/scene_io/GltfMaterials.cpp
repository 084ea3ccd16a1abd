#include "GltfMaterials.h"

#include <algorithm>

#include "GltfPbr.h"
#include "GltfPlacement.h"
#include "GltfReference.h"
#include "weft/scene_io/BTFMaterialLoader.h"

namespace weft {
namespace {

constexpr const char* kBtfExtension = "WEFT_materials_btf";

/// The set that the file's tangents belong to: the normal texture's.
Result<int> tangentSetOf(const GltfFile& file, const tinygltf::Material& material) {
  WEFT_TRY(const TexturePlacement placement,
           placementFrom(file, material.normalTexture.extensions, material.normalTexture.texCoord));
  return placement.set;
}

Result<glm::vec2> btfScale(const GltfFile& file, const tinygltf::Value& extension) {
  WEFT_TRY(const std::vector<double> scale, numbersOf(file, kBtfExtension, extension, "scale", {1.0, 1.0}));
  const glm::vec2 value(scale[0], scale[1]);
  // A negative one would mirror the image, but not the directions that its relief was measured in.
  if (!(value.x > 0.0f && value.y > 0.0f))
    return file.fail(std::string("the scale of ") + kBtfExtension + " is not positive");
  return value;
}

/// A program's own material needs texture coordinates where it is a measured one, or where what it
/// takes the place of has textures.
MeshDress dressOf(std::shared_ptr<const Material> made, const std::string& json) {
  const bool isMeasured = dynamic_cast<const BTFMaterial*>(made.get()) != nullptr;
  const bool hadTextures =
      json.find("Texture\"") != std::string::npos || json.find(kBtfExtension) != std::string::npos;
  return {.material = std::move(made), .usesTexcoords = isMeasured || hadTextures};
}

/// The textures of a material, first those in whose set of texture coordinates the tangents of a
/// mesh must lie.
std::vector<PBRTexture*> tangentTexturesFirst(PBROptions& options) {
  std::vector<PBRTexture*> textures{&options.normalTexture, &options.clearcoat.normalTexture,
                                    &options.anisotropy.texture};
  for (PBRTexture* texture : texturesOf(options))
    if (std::find(textures.begin(), textures.end(), texture) == textures.end()) textures.push_back(texture);
  return textures;
}

/// What has no tangents is shown without what lies along them.
void leaveOutTangents(PBROptions& options) {
  options.normalTexture = options.clearcoat.normalTexture = {};
  options.anisotropy = {};
}

/// The file's, or else `standard`.
Result<Tiling> btfTiling(const GltfFile& file, const tinygltf::Value& extension, Tiling standard) {
  // A map is a tiling of its own.
  if (!extension.Has("tiling")) return extension.Has("map") ? Tiling::Repeat : standard;
  const auto& name = extension.Get("tiling").Get<std::string>();
  if (name == "repeat") return Tiling::Repeat;
  if (name == "stochastic") return Tiling::Stochastic;
  return file.fail("the tiling of " + std::string(kBtfExtension) + " is neither repeat nor stochastic");
}

}  // namespace

Result<MeshDress> GltfMaterials::get(int index, Wearer wearer) {
  if (index < -1 || index >= static_cast<int>(file_.model.materials.size()))
    return file_.fail("material " + std::to_string(index) + " does not exist");
  const tinygltf::Material plain;
  const tinygltf::Material& material =
      index < 0 ? plain : file_.model.materials[static_cast<std::size_t>(index)];
  wearer.hasAlpha &= material.alphaMode == "BLEND";
  if (const auto found = made_.find({index, wearer}); found != made_.end()) return found->second;
  WEFT_TRY(MeshDress dress, make(index, material, wearer));
  if (material.normalTexture.index >= 0) {
    WEFT_TRY(dress.tangentSet, tangentSetOf(file_, material));
  }
  return made_[{index, wearer}] = std::move(dress);
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

Result<MeshDress> GltfMaterials::make(int index, const tinygltf::Material& material, const Wearer& wearer) {
  auto replacement = options_.replacements.find(material.name);
  if (replacement == options_.replacements.end()) replacement = options_.replacements.find("*");
  if (replacement != options_.replacements.end())
    return MeshDress{.material = replacement->second, .usesTexcoords = true};
  if (options_.makeMaterial && index >= 0) {
    GltfMaterial source{file_.path, material.name, {}};
    if (const auto& texts = file_.contents.materials; static_cast<std::size_t>(index) < texts.size())
      source.json = texts[static_cast<std::size_t>(index)];
    WEFT_TRY(std::shared_ptr<const Material> made, options_.makeMaterial(source));
    if (made) return dressOf(std::move(made), source.json);
  }
  return material.extensions.contains(kBtfExtension) ? makeBtf(material, wearer) : makePbr(material, wearer);
}

Result<MeshDress> GltfMaterials::makeBtf(const tinygltf::Material& material, const Wearer& wearer) {
  const tinygltf::Value& extension = material.extensions.at(kBtfExtension);
  WEFT_TRY(const glm::vec2 scale, btfScale(file_, extension));
  WEFT_TRY(const std::vector<double> set, numbersOf(file_, kBtfExtension, extension, "texCoord", {0.0}));
  MeshDress dress{.usesTexcoords = true};
  WEFT_TRY(const int plainSet, texcoordSetFrom(file_, set[0]));
  WEFT_TRY(dress.placement, placementFrom(file_, placementExtensionsOf(extension), plainSet));
  dress.sets = {dress.placement.set, dress.placement.set == 0 ? 1 : 0};
  BTFMaterialOptions options = options_.btf;
  options.textureScale *= scale;
  WEFT_TRY(options.tiling, btfTiling(file_, extension, options.tiling));
  options.doubleSided |= material.doubleSided;
  auto made = loadField(material, extension, options);
  if (!made) {
    warnings_.push_back("the reflectance field of " + quoted(material) +
                        " is left out, its own maps take its place: " + made.error().message());
    return makePbr(material, wearer);
  }
  dress.material = std::move(*made);
  return dress;
}

Result<std::shared_ptr<BTFMaterial>> GltfMaterials::loadField(const tinygltf::Material& material,
                                                              const tinygltf::Value& extension,
                                                              const BTFMaterialOptions& options) {
  WEFT_TRY(const std::filesystem::path path, resolveUri(file_.path, extension.Get("uri").Get<std::string>()));
  std::filesystem::path map;
  if (extension.Has("map")) {
    WEFT_TRY(map, resolveUri(file_.path, extension.Get("map").Get<std::string>()));
  }
  WEFT_TRY(const std::shared_ptr<BTFMaterial> made, loadBTFMaterial(path, options, *fields_, map));
  fieldMaterials_.push_back({material.name, path, made});
  return made;
}

bool GltfMaterials::isOpaque(const PBROptions& options, const Wearer& wearer) const {
  const PBRTexture& base = options.baseColorTexture;
  return options.alphaMode == AlphaMode::Blend && options.baseColor.a == 1.0f && !wearer.hasAlpha &&
         (!base.image || textures_.isOpaque(*base.image));
}

Result<MeshDress> GltfMaterials::makePbr(const tinygltf::Material& material, const Wearer& wearer) {
  WEFT_TRY(PBROptions options, GltfPbr(file_, textures_).read(material));
  if (wearer.shading != Shading::Full) leaveOutTangents(options);
  if (wearer.shading == Shading::Unlit) options.unlit = true;
  if (isOpaque(options, wearer)) options.alphaMode = AlphaMode::Opaque;

  // Rough glass blurs what is behind it.
  constexpr float kVisiblyRough = 0.1f;
  if (options.transmission.factor > 0.0f && options.roughness > kVisiblyRough)
    warnings_.push_back("what is behind " + quoted(material) + " is shown sharp, although it is rough");

  // The tangents of a mesh belong to its first set.
  MeshDress dress{.usesTangents = options.anisotropy.strength > 0.0f};
  std::vector<int> sets;
  for (PBRTexture* texture : tangentTexturesFirst(options)) {
    if (!texture->image) continue;
    if (sets.empty() && material.normalTexture.index < 0) dress.tangentSet = texture->placement.set;
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

}  // namespace weft
