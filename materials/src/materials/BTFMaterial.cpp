#include "weft/materials/BTFMaterial.h"

#include <cmath>

#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/shaders/Bindings.h"

namespace weft {
namespace {

constexpr const char* kMapOrTiling = "a surface has a coordinate map, or stochastic tiling, not both";

FieldBlock blockOf(const BTFTextures& textures, const BTFMaterialOptions& options) {
  FieldBlock block = textures.block();
  block.textureScale = options.textureScale;
  block.tint = options.tint * std::exp2(options.exposure);
  return block;
}

}  // namespace

Result<std::shared_ptr<BTFMaterial>> BTFMaterial::create(std::shared_ptr<const BTFTextures> textures,
                                                         const BTFMaterialOptions& options) {
  WEFT_TRY_VOID(checkOptions(options, *textures));
  return std::shared_ptr<BTFMaterial>(new BTFMaterial(std::move(textures), options));
}

Result<std::shared_ptr<BTFMaterial>> BTFMaterial::create(const std::shared_ptr<const ReflectanceField>& field,
                                                         const BTFMaterialOptions& options) {
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
  if (map && options_.tiling == Tiling::Stochastic) return fail(kMapOrTiling);
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
    const bool isStochastic = options_.tiling == Tiling::Stochastic;
    source.includeAliases["where.glsl"] = isStochastic ? "where_stochastic.glsl" : "where_filtered.glsl";
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
  WEFT_TRY_VOID(checkOptions(options, *textures_));
  if (map_ && options.tiling == Tiling::Stochastic) return fail(kMapOrTiling);
  const bool sameProgram = options.filter == options_.filter && options.tiling == options_.tiling &&
                           options.interpolatedViews == options_.interpolatedViews &&
                           options.doubleSided == options_.doubleSided;
  options_ = options;
  block_->set(blockBytes(blockOf(*textures_, options)));
  if (!sameProgram) setProgram();
  return {};
}

}  // namespace weft
