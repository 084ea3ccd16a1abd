#include "weft/materials/PBRMaterial.h"

#include <array>
#include <cmath>

#include "weft/chunks/BlendChunk.h"
#include "weft/chunks/DepthChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/reflectance/SheenTable.h"
#include "weft/shaders/Bindings.h"

namespace weft {
namespace {

// The block `PBR` of pbr.frag, std140.
struct PlacementBlock {
  glm::vec4 matrix;  ///< columns
  glm::vec4 offset;  ///< xy, z: set
};
struct PBRBlock {
  glm::vec4 baseColor;
  glm::vec4 emission;      ///< rgb, w: alpha cutoff
  glm::vec4 fresnel;       ///< of the dielectric: F0 before it is clamped, w: specular
  glm::vec4 factors;       ///< metallic, roughness, normal scale, occlusion strength
  glm::vec4 tangentFrame;  ///< of the normal texture, columns
  glm::vec4 clearcoat;     ///< factor, roughness, normal scale
  glm::vec4 clearcoatFrame;
  glm::vec4 sheen;            ///< rgb, roughness
  glm::vec4 anisotropyFrame;  ///< columns
  glm::vec4 iridescence;      ///< factor, refractive index, minimum and maximum of the thickness
  glm::vec4 layers;           ///< strength of the anisotropy, transmission
  std::array<PlacementBlock, bindings::pbrUnitCount> placements;
};

PlacementBlock blockOf(const TexturePlacement& placement) {
  const glm::mat2 matrix = placement.matrix();
  return {{matrix[0], matrix[1]}, {placement.offset, placement.set, 0.0f}};
}

glm::vec4 columnsOf(const glm::mat2& matrix) {
  return {matrix[0], matrix[1]};
}

glm::mat2 turned(float rotation) {
  const float c = std::cos(rotation), s = std::sin(rotation);
  return {c, s, -s, c};
}

PBRBlock blockOf(const PBROptions& options) {
  const float ratio = (options.refractiveIndex - 1.0f) / (options.refractiveIndex + 1.0f);
  const Clearcoat& clearcoat = options.clearcoat;
  const Anisotropy& anisotropy = options.anisotropy;
  const Iridescence& film = options.iridescence;
  PBRBlock block{options.baseColor,
                 {options.emission, options.alphaCutoff},
                 {ratio * ratio * options.specularColor, options.specular},
                 {options.metallic, options.roughness, options.normalScale, options.occlusionStrength},
                 columnsOf(options.normalTexture.placement.tangentFrame()),
                 {clearcoat.factor, clearcoat.roughness, clearcoat.normalScale, 0.0f},
                 columnsOf(clearcoat.normalTexture.placement.tangentFrame()),
                 {options.sheen.color, options.sheen.roughness},
                 columnsOf(anisotropy.texture.placement.tangentFrame() * turned(anisotropy.rotation)),
                 {film.factor, film.refractiveIndex, film.minimumThickness, film.maximumThickness},
                 {anisotropy.strength, options.transmission.factor, 0.0f, 0.0f},
                 {}};
  const auto textures = texturesOf(options);
  for (std::size_t unit = 0; unit < textures.size(); ++unit)
    block.placements[unit] = blockOf(textures[unit]->placement);
  return block;
}

/// What pbr.frag calls a unit that has a texture.
constexpr std::array<const char*, bindings::pbrUnitCount> kTextureDefines{
    "BASE_COLOR_TEXTURE",       "METALLIC_ROUGHNESS_TEXTURE", "NORMAL_TEXTURE",
    "EMISSION_TEXTURE",         "OCCLUSION_TEXTURE",          "SPECULAR_TEXTURE",
    "SPECULAR_COLOR_TEXTURE",   "CLEARCOAT_TEXTURE",          "CLEARCOAT_ROUGHNESS_TEXTURE",
    "CLEARCOAT_NORMAL_TEXTURE", "SHEEN_COLOR_TEXTURE",        "SHEEN_ROUGHNESS_TEXTURE",
    "ANISOTROPY_TEXTURE",       "IRIDESCENCE_TEXTURE",        "IRIDESCENCE_THICKNESS_TEXTURE",
    "TRANSMISSION_TEXTURE"};

/// Metals let nothing pass.
bool transmits(const PBROptions& options) {
  const bool canPass = options.metallic < 1.0f || options.metallicRoughnessTexture.image;
  return options.transmission.factor > 0.0f && canPass && !options.unlit;
}

bool hasSheen(const PBROptions& options) {
  return options.sheen.color != glm::vec3(0.0f) && !options.unlit;
}

/// The layers that are compiled in.
std::vector<const char*> layersOf(const PBROptions& options) {
  if (options.unlit) return {"UNLIT"};
  std::vector<const char*> layers;
  if (options.clearcoat.factor > 0.0f) layers.push_back("CLEARCOAT");
  if (hasSheen(options)) layers.push_back("SHEEN");
  if (options.anisotropy.strength > 0.0f) layers.push_back("ANISOTROPY");
  if (options.iridescence.factor > 0.0f) layers.push_back("IRIDESCENCE");
  if (transmits(options)) layers.push_back("TRANSMISSION");
  return layers;
}

/// Takes a while, and is the same for all.
std::shared_ptr<const FloatImage> sheenTable() {
  static const auto table = std::make_shared<const FloatImage>(SheenTable().image());
  return table;
}

}  // namespace

PBRMaterial::PBRMaterial(const PBROptions& options) : options_(options) {
  ShaderSource source{.vertex = "mesh.vert", .fragment = "pbr.frag"};
  const auto define = [&](const char* name) { source.defines.emplace_back(name, ""); };
  const auto textures = texturesOf(options_);
  for (unsigned unit = 0; unit < textures.size(); ++unit) {
    const bool isShown = !options.unlit || unit == bindings::baseColorUnit || unit == bindings::emissionUnit;
    if (!isShown || !textures[unit]->image) continue;
    setChunk(textureSlot(unit), textures[unit]->image);
    define(kTextureDefines[unit]);
  }
  for (const char* layer : layersOf(options)) define(layer);
  if (hasSheen(options))
    setChunk(textureSlot(bindings::sheenTableUnit),
             std::make_shared<TextureChunk>(sheenTable(), TextureOptions{.filter = TextureFilter::Linear}));
  if (options.alphaMode == AlphaMode::Mask) define("ALPHA_MASK");
  if (options.alphaMode == AlphaMode::Blend) define("ALPHA_BLEND");
  if (options.alphaMode == AlphaMode::Blend || transmits(options)) {
    setChunk(BlendSlot,
             std::make_shared<BlendChunk>(transmits(options) ? BlendKind::Tint : BlendKind::Alpha));
    setChunk(DepthSlot, std::make_shared<DepthChunk>(true, false));
  }
  if (options.doubleSided) setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::None));
  setChunk(ProgramSlot, std::make_shared<ProgramChunk>(std::move(source)));
  setChunk(uniformSlot(bindings::materialBinding),
           std::make_shared<UniformBlockChunk>(blockBytes(blockOf(options))));
  coverage_ = state();
  coverage_.set(BlendSlot, nullptr);
  coverage_.set(DepthSlot, std::make_shared<DepthChunk>());
  coverage_.set(RasterSlot, nullptr);  // both sides keep light off
}

const State* PBRMaterial::coverage() const {
  const bool isOpaque = options_.alphaMode == AlphaMode::Opaque && !transmits(options_);
  return isOpaque ? nullptr : &coverage_;
}

}  // namespace weft
