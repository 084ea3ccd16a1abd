#include "weft/materials/PBRMaterial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "weft/chunks/BlendChunk.h"
#include "weft/chunks/DepthChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
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
  std::array<PlacementBlock, bindings::pbrUnitCount> placements;
};

PlacementBlock blockOf(const TexturePlacement& placement) {
  const glm::mat2 matrix = placement.matrix();
  return {{matrix[0], matrix[1]}, {placement.offset, placement.set, 0.0f}};
}

PBRBlock blockOf(const PBROptions& options) {
  const float ratio = (options.refractiveIndex - 1.0f) / (options.refractiveIndex + 1.0f);
  const glm::mat2 frame = options.normalTexture.placement.tangentFrame();
  return {options.baseColor,
          {options.emission, options.alphaCutoff},
          {ratio * ratio * options.specularColor, options.specular},
          {options.metallic, options.roughness, options.normalScale, options.occlusionStrength},
          {frame[0], frame[1]},
          {blockOf(options.baseColorTexture.placement), blockOf(options.metallicRoughnessTexture.placement),
           blockOf(options.normalTexture.placement), blockOf(options.emissionTexture.placement),
           blockOf(options.occlusionTexture.placement), blockOf(options.specularTexture.placement),
           blockOf(options.specularColorTexture.placement)}};
}

}  // namespace

glm::mat2 TexturePlacement::matrix() const {
  const float c = std::cos(rotation), s = std::sin(rotation);
  return {scale.x * glm::vec2(c, -s), scale.y * glm::vec2(s, c)};
}

glm::mat2 TexturePlacement::tangentFrame() const {
  if (scale.x == 0.0f || scale.y == 0.0f) return glm::mat2(1.0f);
  // Where u' grows and v' stays, as steps in u along the tangent and in v against the bitangent.
  const glm::vec2 step = glm::inverse(matrix())[0];
  const glm::vec2 tangent = glm::normalize(glm::vec2(step.x, -step.y));
  const float handedness = scale.x * scale.y < 0.0f ? -1.0f : 1.0f;
  return {tangent, handedness * glm::vec2(-tangent.y, tangent.x)};
}

PBRMaterial::PBRMaterial(const PBROptions& options) : options_(options) {
  ShaderSource source{.vertex = "mesh.vert", .fragment = "pbr.frag"};
  const auto define = [&](const char* name) { source.defines.emplace_back(name, ""); };
  const auto add = [&](unsigned unit, const PBRTexture& texture, const char* name) {
    if (!texture.image) return;
    setChunk(textureSlot(unit), texture.image);
    define(name);
  };
  add(bindings::baseColorUnit, options.baseColorTexture, "BASE_COLOR_TEXTURE");
  add(bindings::emissionUnit, options.emissionTexture, "EMISSION_TEXTURE");
  if (options.unlit) {
    define("UNLIT");
  } else {
    add(bindings::metallicRoughnessUnit, options.metallicRoughnessTexture, "METALLIC_ROUGHNESS_TEXTURE");
    add(bindings::normalUnit, options.normalTexture, "NORMAL_TEXTURE");
    add(bindings::occlusionUnit, options.occlusionTexture, "OCCLUSION_TEXTURE");
    add(bindings::specularUnit, options.specularTexture, "SPECULAR_TEXTURE");
    add(bindings::specularColorUnit, options.specularColorTexture, "SPECULAR_COLOR_TEXTURE");
  }
  if (options.alphaMode == AlphaMode::Mask) define("ALPHA_MASK");
  if (options.alphaMode == AlphaMode::Blend) {
    define("ALPHA_BLEND");
    setChunk(BlendSlot, std::make_shared<BlendChunk>());
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

}  // namespace weft
