#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>

#include "weft/chunks/TextureChunk.h"
#include "weft/materials/ChunkMaterial.h"

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
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  ///< draw back faces, too, with the normals (mapped ones, too) reversed
  /// KHR_materials_unlit: shows base colour + emission, without any light
  bool unlit = false;
};

/// A surface as nearly every glTF file describes it (glTF 2.0, appendix B): a diffuse dielectric
/// below GGX microfacets, mixed with a metal, under point and directional lights and an
/// environment.
///
/// Multiplies by the mesh's vertex colours. Numbers must be finite, factors within 0..1. The
/// formula: specular = D V with GGX and Smith's height-correlated shadowing; metal = specular
/// mix(base, 1, w); dielectric = (1 - max F) base / pi + F specular with F = mix(F0, F90, w), w =
/// (1 - v.h)^5; mixed by `metallic`. Under an environment specular becomes a split sum:
/// MicrofacetTable times the average of what the microfacets mirror. GLSL: shaders/pbr.frag.
class PBRMaterial : public ChunkMaterial {
 public:
  explicit PBRMaterial(const PBROptions& options = {});

  const PBROptions& options() const { return options_; }
  const State* coverage() const override {
    return options_.alphaMode == AlphaMode::Opaque ? nullptr : &coverage_;
  }

 private:
  PBROptions options_;
  State coverage_;
};

}  // namespace weft
