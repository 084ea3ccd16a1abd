#include "weft/materials/BTFMaterial.h"

#include <fmt/format.h>

#include "weft/chunks/CubeTextureChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/reflectance/FieldTextures.h"

namespace weft {
namespace {

constexpr int kMaximumLayers = 2048;

ShaderSource sourceOf(const FieldProgram& program, const BTFMaterialOptions& options) {
  ShaderSource source{.vertex = "mesh.vert", .fragment = "btf.frag"};
  source.defines.assign(program.defines.begin(), program.defines.end());
  source.includeAliases = program.includeAliases;
  source.texts = program.texts;
  if (options.interpolatedViews == 1) source.defines.emplace_back("NEAREST_LAYER", "");
  if (options.filter == TexelFilter::Bilinear) source.defines.emplace_back("BILINEAR", "");
  return source;
}

std::shared_ptr<const Chunk> arrayOf(TextureImage image) {
  return std::make_shared<TextureChunk>(std::make_shared<const TextureImage>(std::move(image)),
                                        TextureOptions{.shape = TextureShape::Array});
}

std::shared_ptr<const Chunk> tableOf(FloatImage image) {
  return std::make_shared<TextureChunk>(std::make_shared<const FloatImage>(std::move(image)),
                                        TextureOptions{.shape = TextureShape::Rectangle});
}

}  // namespace

Result<std::shared_ptr<BTFMaterial>> BTFMaterial::create(std::shared_ptr<const ReflectanceField> field,
                                                         const BTFMaterialOptions& options) {
  if (options.interpolatedViews != 1 && options.interpolatedViews != 3)
    return fail(fmt::format("{} views cannot be interpolated", options.interpolatedViews), {}, "1 or 3");
  if (!(options.textureScale.x > 0.0f && options.textureScale.y > 0.0f))
    return fail(fmt::format("the texture cannot be scaled by {} x {}", options.textureScale.x,
                            options.textureScale.y),
                {}, "numbers above 0");
  const int layers = FieldTextures::arrayLayers(field->formula());
  if (layers > kMaximumLayers)
    return fail(fmt::format("the field needs {} texture layers of at most {}", layers, kMaximumLayers));
  if (field->tables().size() > FieldProgram::kMostTables)
    return fail(fmt::format("the field has {} tables of at most {}", field->tables().size(),
                            FieldProgram::kMostTables));

  std::shared_ptr<BTFMaterial> material(new BTFMaterial(field));
  FieldTextures textures = FieldTextures::create(*field, options.preparedForEnvironments);
  FieldProgram program = FieldProgram::create(*field);
  program.block.textureScale = options.textureScale;
  ShaderSource source = sourceOf(program, options);
  if (!textures.preparedLayers.empty()) {
    source.defines.emplace_back("ENVIRONMENT_LAYERS", "");
    material->setChunk(textureSlot(5), arrayOf(std::move(textures.preparedLayers)));
  }
  material->setChunk(ProgramSlot, std::make_shared<ProgramChunk>(std::move(source)));
  material->setChunk(uniformSlot(2), std::make_shared<UniformBlockChunk>(blockBytes(program.block)));
  material->setChunk(textureSlot(1), arrayOf(std::move(textures.shared)));
  if (layers > 0) {
    material->setChunk(textureSlot(0), arrayOf(std::move(textures.layers)));
    material->setChunk(textureSlot(2), std::make_shared<CubeTextureChunk>(std::make_shared<const FloatImage>(
                                           std::move(program.lookup.triangleOfDirection))));
    material->setChunk(textureSlot(3), tableOf(std::move(program.lookup.triangles)));
  }
  unsigned unit = FieldProgram::kFirstTableUnit;
  for (auto& [name, table] : textures.tables)
    material->setChunk(textureSlot(unit++), arrayOf(std::move(table)));
  if (!program.quadrature.empty()) material->setChunk(textureSlot(4), tableOf(std::move(program.quadrature)));
  if (options.doubleSided) material->setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::None));
  return material;
}

}  // namespace weft
