#include "weft/materials/BTFMaterial.h"

#include <fmt/format.h>

#include <algorithm>

#include "weft/chunks/CubeTextureChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/reflectance/ViewLookup.h"

namespace weft {
namespace {

constexpr int kMaximumLayers = 2048;

// The block `ReflectanceField` of btf.frag, std140.
struct FieldBlock {
  glm::vec2 textureScale;
  float lowestLightZ;
  float padding = 0.0f;
};

int texelsFor(const FloatImage& image) {
  return (image.channelCount() + 3) / 4;
}

// As RGBA, a layer for every four channels of every layer: the last texel of a layer may have spare numbers.
std::shared_ptr<const FloatImage> packed(const FloatImage& image) {
  const int texels = texelsFor(image);
  auto result = std::make_shared<FloatImage>(
      image.width(), image.height(), std::vector<std::string>{"R", "G", "B", "A"}, image.layers() * texels);
  for (int layer = 0; layer < image.layers(); ++layer)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        for (int channel = 0; channel < image.channelCount(); ++channel)
          result->at(x, y, channel % 4, layer * texels + channel / 4) = image.at(x, y, channel, layer);
  result->setPrecision(image.precision());
  return result;
}

ShaderSource sourceFor(const ReflectanceField& field, const BTFMaterialOptions& options) {
  ShaderSource source{.vertex = "mesh.vert", .fragment = "btf.frag"};
  for (const auto& define : field.model().shaderDefines()) source.defines.push_back(define);
  if (field.description().hasCosine) source.defines.emplace_back("MODEL_HAS_COSINE", "");
  if (options.interpolatedViews == 1) source.defines.emplace_back("NEAREST_VIEW", "");
  if (options.filter == TexelFilter::Bilinear) source.defines.emplace_back("BILINEAR", "");
  source.includeAliases["model.glsl"] = field.model().shaderFile();
  return source;
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
  if (field->viewCount() * texelsFor(field->views()) > kMaximumLayers)
    return fail(fmt::format("{} views of {} texels are more than {} layers", field->viewCount(),
                            texelsFor(field->views()), kMaximumLayers));

  const ViewLookup lookup = ViewLookup::create(field->triangulation());
  std::shared_ptr<BTFMaterial> material(new BTFMaterial(field));
  material->setChunk(ProgramSlot, std::make_shared<ProgramChunk>(sourceFor(*field, options)));
  material->setChunk(
      textureSlot(0),
      std::make_shared<TextureChunk>(packed(field->views()), TextureOptions{.shape = TextureShape::Array}));
  material->setChunk(textureSlot(1), std::make_shared<TextureChunk>(packed(field->shared())));
  material->setChunk(textureSlot(2), std::make_shared<CubeTextureChunk>(
                                         std::make_shared<const FloatImage>(lookup.triangleOfDirection)));
  material->setChunk(textureSlot(3),
                     std::make_shared<TextureChunk>(std::make_shared<const FloatImage>(lookup.triangles),
                                                    TextureOptions{.shape = TextureShape::Rectangle}));
  material->setChunk(uniformSlot(2), std::make_shared<UniformBlockChunk>(blockBytes(
                                         FieldBlock{options.textureScale, field->lowestLightZ()})));
  if (options.doubleSided) material->setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::None));
  return material;
}

}  // namespace weft
