#include "weft/materials/BTFMaterial.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/vector_relational.hpp>

#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/shaders/Bindings.h"

namespace weft {
namespace {

constexpr float kLargestFactor = 1e30f;

Result<void> check(const BTFMaterialOptions& options) {
  if (options.interpolatedViews != 1 && options.interpolatedViews != 3)
    return fail(fmt::format("{} views cannot be interpolated", options.interpolatedViews), {}, "1 or 3");
  const auto& [x, y] = std::pair(options.textureScale.x, options.textureScale.y);
  if (!(x > 0.0f && y > 0.0f && std::isfinite(x) && std::isfinite(y)))
    return fail(fmt::format("the texture cannot be scaled by {} x {}", x, y), {}, "numbers above 0");
  const glm::vec3 tint = options.tint * std::exp2(options.exposure);
  if (!glm::all(glm::greaterThanEqual(tint, glm::vec3(0.0f))) ||
      !glm::all(glm::lessThanEqual(tint, glm::vec3(kLargestFactor))))
    return fail(fmt::format("a tint of {}, {}, {} with an exposure of {} stops cannot be shown",
                            options.tint.x, options.tint.y, options.tint.z, options.exposure),
                {}, "numbers from 0");
  return {};
}

FieldBlock blockOf(const BTFTextures& textures, const BTFMaterialOptions& options) {
  FieldBlock block = textures.block();
  block.textureScale = options.textureScale;
  block.tint = options.tint * std::exp2(options.exposure);
  return block;
}

}  // namespace

Result<std::shared_ptr<BTFMaterial>> BTFMaterial::create(std::shared_ptr<const BTFTextures> textures,
                                                         const BTFMaterialOptions& options) {
  WEFT_TRY_VOID(check(options));
  return std::shared_ptr<BTFMaterial>(new BTFMaterial(std::move(textures), options));
}

Result<std::shared_ptr<BTFMaterial>> BTFMaterial::create(const std::shared_ptr<const ReflectanceField>& field,
                                                         const BTFMaterialOptions& options) {
  WEFT_TRY_VOID(check(options));
  WEFT_TRY(auto textures, BTFTextures::create(*field, options.preparedForEnvironments));
  return create(std::move(textures), options);
}

BTFMaterial::BTFMaterial(std::shared_ptr<const BTFTextures> textures, const BTFMaterialOptions& options)
    : textures_(std::move(textures)),
      options_(options),
      block_(std::make_shared<UniformBlockChunk>(blockBytes(blockOf(*textures_, options)))) {
  for (const auto& [slot, chunk] : textures_->chunks()) setChunk(slot, chunk);
  setChunk(uniformSlot(bindings::materialBinding), block_);
  setProgram();
}

Result<void> BTFMaterial::setMap(std::shared_ptr<const BTFMap> map) {
  if (map && !map->fits(*textures_)) return fail("the coordinate map is of another field");
  if (map_)
    for (const auto& [slot, chunk] : map_->chunks()) setChunk(slot, nullptr);
  map_ = std::move(map);
  for (const auto& [slot, chunk] : textures_->chunks()) setChunk(slot, chunk);
  if (map_)
    for (const auto& [slot, chunk] : map_->chunks()) setChunk(slot, chunk);
  setProgram();
  return {};
}

void BTFMaterial::setProgram() {
  ShaderSource source = textures_->source();
  source.includeAliases["surface.glsl"] = map_ ? "surface_mapped.glsl" : "surface_sample.glsl";
  const bool isBilinear = options_.filter == TexelFilter::Bilinear;
  if (textures_->filtersParameters()) {
    source.includeAliases["where.glsl"] = "where_filtered.glsl";
    if (map_) source.includeAliases["fetch.glsl"] = "fetch_mapped.glsl";
    if (!isBilinear) source.defines.emplace_back("NEAREST_TEXEL", "");
  } else if (textures_->sumsLevels()) {
    source.includeAliases["where.glsl"] = "where_levels.glsl";
    if (!isBilinear) source.defines.emplace_back("NEAREST_TEXEL", "");
  } else {
    source.includeAliases["where.glsl"] = isBilinear ? "where_bilinear.glsl" : "where_texel.glsl";
  }
  if (options_.interpolatedViews == 1) source.defines.emplace_back("NEAREST_LAYER", "");
  setChunk(ProgramSlot, std::make_shared<ProgramChunk>(std::move(source)));
  setChunk(RasterSlot, std::make_shared<RasterChunk>(options_.doubleSided ? Culling::None : Culling::Back));
}

Result<void> BTFMaterial::setOptions(const BTFMaterialOptions& options) {
  WEFT_TRY_VOID(check(options));
  const bool sameProgram = options.filter == options_.filter &&
                           options.interpolatedViews == options_.interpolatedViews &&
                           options.doubleSided == options_.doubleSided;
  options_ = options;
  block_->set(blockBytes(blockOf(*textures_, options)));
  if (!sameProgram) setProgram();
  return {};
}

}  // namespace weft
