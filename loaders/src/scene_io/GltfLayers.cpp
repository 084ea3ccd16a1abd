#include "GltfLayers.h"

#include "GltfExtension.h"

namespace weft {
namespace {

Result<void> readClearcoat(const GltfExtension& extension, PBROptions& options) {
  Clearcoat& coat = options.clearcoat;
  WEFT_TRY_VOID(extension.texturedFactor("clearcoatFactor", "clearcoatTexture", "clearcoat", coat.factor,
                                         coat.texture));
  if (coat.factor == 0.0f) return {};
  WEFT_TRY(coat.roughness, extension.factor("clearcoatRoughnessFactor", 0.0));
  WEFT_TRY(coat.roughnessTexture,
           extension.texture("clearcoatRoughnessTexture", false, "clearcoat roughness"));
  constexpr const char* kNormal = "clearcoatNormalTexture";
  WEFT_TRY(coat.normalTexture, extension.texture(kNormal, false, "clearcoat normal"));
  if (extension.has(kNormal) && extension.value().Get(kNormal).Has("scale"))
    coat.normalScale = static_cast<float>(extension.value().Get(kNormal).Get("scale").GetNumberAsDouble());
  return {};
}

Result<void> readSheen(const GltfExtension& extension, PBROptions& options) {
  Sheen& sheen = options.sheen;
  WEFT_TRY(const glm::vec3 color, extension.color("sheenColorFactor", 0.0));
  if (color == glm::vec3(0.0f)) return {};
  WEFT_TRY(sheen.colorTexture, extension.texture("sheenColorTexture", true, "sheen colour"));
  // Without its texture the factor means nothing.
  if (extension.has("sheenColorTexture") && !sheen.colorTexture.image) return {};
  sheen.color = glm::min(color, glm::vec3(1.0f));
  WEFT_TRY(sheen.roughness, extension.factor("sheenRoughnessFactor", 0.0));
  WEFT_TRY(sheen.roughnessTexture, extension.texture("sheenRoughnessTexture", false, "sheen roughness"));
  return {};
}

Result<void> readAnisotropy(const GltfExtension& extension, PBROptions& options) {
  Anisotropy& anisotropy = options.anisotropy;
  WEFT_TRY_VOID(extension.texturedFactor("anisotropyStrength", "anisotropyTexture", "anisotropy",
                                         anisotropy.strength, anisotropy.texture));
  WEFT_TRY(const double rotation, extension.number("anisotropyRotation", 0.0));
  anisotropy.rotation = static_cast<float>(rotation);
  return {};
}

Result<void> readIridescence(const GltfExtension& extension, PBROptions& options) {
  Iridescence& film = options.iridescence;
  WEFT_TRY_VOID(extension.texturedFactor("iridescenceFactor", "iridescenceTexture", "iridescence",
                                         film.factor, film.texture));
  if (film.factor == 0.0f) return {};
  WEFT_TRY(const double index, extension.number("iridescenceIor", 1.3));
  WEFT_TRY(const double least, extension.number("iridescenceThicknessMinimum", 100.0));
  WEFT_TRY(const double greatest, extension.number("iridescenceThicknessMaximum", 400.0));
  film.refractiveIndex = static_cast<float>(std::max(index, 1.0));
  film.minimumThickness = static_cast<float>(std::max(least, 0.0));
  film.maximumThickness = static_cast<float>(std::max(greatest, 0.0));
  WEFT_TRY(film.thicknessTexture,
           extension.texture("iridescenceThicknessTexture", false, "iridescence thickness"));
  return {};
}

Result<void> readTransmission(const GltfExtension& extension, PBROptions& options) {
  return extension.texturedFactor("transmissionFactor", "transmissionTexture", "transmission",
                                  options.transmission.factor, options.transmission.texture);
}

}  // namespace

Result<void> readLayers(const GltfFile& file, GltfTextures& textures, const tinygltf::Material& material,
                        const std::string& of, PBROptions& options) {
  const std::pair<const char*, Result<void> (*)(const GltfExtension&, PBROptions&)> readers[] = {
      {"KHR_materials_clearcoat", readClearcoat},
      {"KHR_materials_sheen", readSheen},
      {"KHR_materials_anisotropy", readAnisotropy},
      {"KHR_materials_iridescence", readIridescence},
      {"KHR_materials_transmission", readTransmission}};
  for (const auto& [name, reader] : readers) {
    const auto found = material.extensions.find(name);
    if (found == material.extensions.end()) continue;
    WEFT_TRY_VOID(reader(GltfExtension(file, textures, name, found->second, of), options));
  }
  return {};
}

}  // namespace weft
