#pragma once

#include <array>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "weft/chunks/TextureChunk.h"
#include "weft/shaders/Bindings.h"

namespace weft {

/// How a texture lies on the surface (KHR_texture_transform): `set` 0 or 1 of the mesh's texture
/// coordinates, scaled, then turned counter-clockwise (V runs down) by `rotation` radians, then
/// moved.
struct TexturePlacement {
  int set = 0;
  glm::vec2 scale{1.0f};
  float rotation = 0.0f;
  glm::vec2 offset{0.0f};

  /// Turned and scaled: what (u, v) is multiplied by before it is moved.
  glm::mat2 matrix() const;
  /// The unit directions in which the image's columns grow and its rows fall, in units of the
  /// tangent and bitangent of its set of texture coordinates: column 0 and 1. Mirrored where a
  /// scale is negative.
  glm::mat2 tangentFrame() const;
};

/// A texture of a PBRMaterial; without an image it counts as white (a normal texture: as level).
/// Materials may share images.
struct PBRTexture {
  std::shared_ptr<const TextureChunk> image{};
  TexturePlacement placement{};
};

/// What the alpha of the base colour does.
enum class AlphaMode {
  Opaque,  ///< nothing: 1 is written
  Mask,    ///< below the cutoff nothing is drawn, otherwise it is opaque
  Blend,   ///< what is behind shines through; drawn after all opaque things, without writing depth
};

/// KHR_materials_clearcoat: a clear coat of refractive index 1.5 on top of everything else.
struct Clearcoat {
  float factor = 0.0f;   ///< 0 (none) to 1
  PBRTexture texture{};  ///< r: factor
  float roughness = 0.0f;
  PBRTexture roughnessTexture{};  ///< g: roughness
  /// The coat's own, as PBROptions::normalTexture; without one it lies flat on the mesh.
  PBRTexture normalTexture{};
  float normalScale = 1.0f;
};

/// KHR_materials_sheen: fibres that stand up from cloth and shine around its outline.
struct Sheen {
  glm::vec3 color{0.0f};          ///< 0: none
  PBRTexture colorTexture{};      ///< made with TextureOptions::srgb
  float roughness = 0.0f;         ///< below 0.07 it counts as that
  PBRTexture roughnessTexture{};  ///< a: roughness
};

/// KHR_materials_anisotropy: highlights that are longer along one direction, as of brushed metal.
struct Anisotropy {
  float strength = 0.0f;  ///< 0 (none) to 1
  float rotation = 0.0f;  ///< of the direction, radians counter-clockwise from the tangent
  PBRTexture texture{};   ///< rg: a direction, from -1 to 1, before it is rotated; b: strength
};

/// KHR_materials_iridescence: a thin film in which light interferes.
struct Iridescence {
  float factor = 0.0f;   ///< 0 (none) to 1
  PBRTexture texture{};  ///< r: factor
  float refractiveIndex = 1.3f;
  /// Of the film, in nanometres; without a texture it is the maximum everywhere.
  float minimumThickness = 100.0f, maximumThickness = 400.0f;
  PBRTexture thicknessTexture{};  ///< g: 0 for the minimum, 1 for the maximum
};

/// KHR_materials_transmission: of what enters a dielectric, this share passes it, tinted by the
/// base colour. The surface is infinitely thin: nothing is bent.
struct Transmission {
  float factor = 0.0f;   ///< 0 (none) to 1
  PBRTexture texture{};  ///< r: factor
};

/// The metallic-roughness material of glTF 2.0. Colours are linear; factors multiply their
/// textures.
struct PBROptions {
  glm::vec4 baseColor{1.0f};
  PBRTexture baseColorTexture{};  ///< made with TextureOptions::srgb
  float metallic = 1.0f;          ///< 0 (glass, cloth) to 1
  /// 0..1; below 0.045 it counts as that, so that highlights stay finite
  float roughness = 1.0f;
  PBRTexture metallicRoughnessTexture{};  ///< g: roughness, b: metallic
  /// in the tangent frame of its texture coordinates, y up the image
  PBRTexture normalTexture{};
  float normalScale = 1.0f;  ///< of its x and y
  /// r: how much of the surroundings a point sees: of light from an environment alone (glTF 3.9.3).
  PBRTexture occlusionTexture{};
  float occlusionStrength = 1.0f;
  glm::vec3 emission{0.0f};      ///< radiance, beyond 1 with KHR_materials_emissive_strength
  PBRTexture emissionTexture{};  ///< made with TextureOptions::srgb
  /// KHR_materials_specular: 0 leaves of a dielectric the diffuse part alone
  float specular = 1.0f;
  glm::vec3 specularColor{1.0f};
  PBRTexture specularTexture{};       ///< a: specular
  PBRTexture specularColorTexture{};  ///< made with TextureOptions::srgb
  float refractiveIndex = 1.5f;       ///< of a dielectric (KHR_materials_ior)
  Clearcoat clearcoat{};
  Sheen sheen{};
  Anisotropy anisotropy{};
  Iridescence iridescence{};
  Transmission transmission{};
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  ///< draw back faces, too, with the normals (mapped ones, too) reversed
  /// KHR_materials_unlit: shows base colour + emission, without any light
  bool unlit = false;
};

/// The textures of a material in the order of their units (shaders/bindings.h).
std::array<PBRTexture*, bindings::pbrUnitCount> texturesOf(PBROptions& options);
std::array<const PBRTexture*, bindings::pbrUnitCount> texturesOf(const PBROptions& options);

}  // namespace weft
