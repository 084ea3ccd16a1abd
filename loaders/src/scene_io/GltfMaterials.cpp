#include "GltfMaterials.h"

#include <cmath>

#include "weft/io/ImageFile.h"
#include "weft/materials/LambertMaterial.h"
#include "weft/scene_io/BTFMaterialLoader.h"

namespace weft {
namespace {

constexpr const char* kBtfExtension = "WEFT_materials_btf";

std::string quoted(const tinygltf::Material& material) {
  return "material \"" + material.name + "\"";
}

/// Says what the missing or broken file is for.
tl::unexpected<Error> becauseOf(Error error, const GltfFile& file, const std::string& use) {
  const std::string hint = "it is the " + use + " of " + file.path.filename().string();
  error.hint = error.hint.empty() ? hint : hint + "; " + error.hint;
  return tl::unexpected<Error>(std::move(error));
}

Result<glm::vec2> btfScale(const GltfFile& file, const tinygltf::Value& extension) {
  if (!extension.Has("scale")) return glm::vec2(1.0f);
  const tinygltf::Value& scale = extension.Get("scale");
  if (scale.ArrayLen() != 2 || !scale.Get(0).IsNumber() || !scale.Get(1).IsNumber())
    return file.fail(std::string("the scale of ") + kBtfExtension + " is not two numbers");
  const glm::vec2 value(scale.Get(0).GetNumberAsDouble(), scale.Get(1).GetNumberAsDouble());
  // A negative one would mirror the image, but not the directions that its relief was measured in.
  if (!(value.x > 0.0f && value.y > 0.0f) || !std::isfinite(value.x) || !std::isfinite(value.y))
    return file.fail(std::string("the scale of ") + kBtfExtension + " is not positive, or too large");
  return value;
}

}  // namespace

Result<std::shared_ptr<const Material>> GltfMaterials::get(int index) {
  if (const auto found = made_.find(index); found != made_.end()) return found->second.material;
  if (index < -1 || index >= static_cast<int>(file_.model.materials.size()))
    return file_.fail("material " + std::to_string(index) + " does not exist");
  const tinygltf::Material material =
      index < 0 ? tinygltf::Material() : file_.model.materials[static_cast<std::size_t>(index)];
  auto replacement = options_.replacements.find(material.name);
  if (replacement == options_.replacements.end()) replacement = options_.replacements.find("*");

  std::shared_ptr<const Material> made;
  if (replacement != options_.replacements.end()) {
    made = replacement->second;
  } else {
    WEFT_TRY(made, make(material));
  }
  made_[index] = {material.name, made};
  return made;
}

std::vector<std::string> GltfMaterials::names() const {
  std::vector<std::string> names;
  for (const auto& [index, named] : made_) names.push_back(named.name);
  return names;
}

Result<std::shared_ptr<const Material>> GltfMaterials::make(const tinygltf::Material& material) {
  if (material.alphaMode != "OPAQUE")
    warnings_.push_back(quoted(material) + " is drawn opaque, its alphaMode is " + material.alphaMode);
  return material.extensions.contains(kBtfExtension) ? makeBtf(material) : makeLambert(material);
}

Result<std::shared_ptr<const Material>> GltfMaterials::makeBtf(const tinygltf::Material& material) {
  const tinygltf::Value& extension = material.extensions.at(kBtfExtension);
  if (!extension.IsObject() || !extension.Get("uri").IsString())
    return file_.fail(quoted(material) + " has " + kBtfExtension + " without a uri");
  if (extension.Has("texCoord") &&
      (!extension.Get("texCoord").IsNumber() || extension.Get("texCoord").GetNumberAsInt() != 0))
    return file_.fail(quoted(material) + " uses texture coordinates other than TEXCOORD_0");
  WEFT_TRY(const glm::vec2 scale, btfScale(file_, extension));
  BTFMaterialOptions options = options_.btf;
  options.textureScale *= scale;
  options.doubleSided |= material.doubleSided;
  auto made = loadBTFMaterial(resolve(file_, extension.Get("uri").Get<std::string>()), options);
  if (!made) return becauseOf(std::move(made).error(), file_, "reflectance field of " + quoted(material));
  return std::shared_ptr<const Material>(std::move(*made));
}

Result<std::shared_ptr<const Material>> GltfMaterials::makeLambert(const tinygltf::Material& material) {
  LambertOptions options;
  const std::vector<double>& factor = material.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() != 4)
    return file_.fail("the baseColorFactor of " + quoted(material) + " is not four numbers");
  options.baseColor = {factor[0], factor[1], factor[2], factor[3]};
  options.doubleSided = material.doubleSided;
  WEFT_TRY(options.baseColorTexture, baseColor(material));
  return std::shared_ptr<const Material>(std::make_shared<LambertMaterial>(options));
}

Result<std::shared_ptr<const Image>> GltfMaterials::baseColor(const tinygltf::Material& material) {
  const tinygltf::TextureInfo& info = material.pbrMetallicRoughness.baseColorTexture;
  if (info.index < 0) return nullptr;
  if (info.texCoord != 0 || info.extensions.contains("KHR_texture_transform"))
    warnings_.push_back("the base colour of " + quoted(material) +
                        " is drawn with untransformed TEXCOORD_0, the file says otherwise");
  if (static_cast<std::size_t>(info.index) >= file_.model.textures.size())
    return file_.fail("texture " + std::to_string(info.index) + " does not exist");
  const int index = file_.model.textures[static_cast<std::size_t>(info.index)].source;
  if (const auto found = images_.find(index); found != images_.end()) return found->second;

  const std::string use = "base colour of " + quoted(material);
  auto bytes = imageBytes(file_, index);
  if (!bytes) return becauseOf(std::move(bytes).error(), file_, use);
  const std::string& uri = file_.model.images[static_cast<std::size_t>(index)].uri;
  auto image = decodeImage(*bytes, uri.empty() ? file_.path.string() : resolve(file_, uri).string());
  if (!image) return becauseOf(std::move(image).error(), file_, use);
  return images_[index] = std::make_shared<const Image>(std::move(*image));
}

}  // namespace weft
