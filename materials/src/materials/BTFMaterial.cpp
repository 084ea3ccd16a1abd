#include "weft/materials/BTFMaterial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "weft/chunks/CubeTextureChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/RasterChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/chunks/UniformBlockChunk.h"
#include "weft/reflectance/LayerLookup.h"

namespace weft {
namespace {

constexpr int kMaximumLayers = 2048;

// The block `ReflectanceField` of btf.frag, std140.
struct FieldBlock {
  glm::vec2 textureScale;
  float lowestLightZ;
  float lowestViewZ;
  float quadratureExponent;
  float unused[3] = {};
};

// Channels `first`.. of a layer of `from`, four a texel, into layers `layer`.. of `to`.
void packNumbers(const FloatImage& from, int fromLayer, int first, int count, FloatImage& to, int layer,
                 int component) {
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x)
      for (int i = 0; i < count; ++i)
        to.at(x, y, (component + i) % 4, layer + (component + i) / 4) = from.at(x, y, first + i, fromLayer);
}

FloatImage rgbaLayers(const ReflectanceField& field, int layers) {
  return FloatImage(field.width(), field.height(), {"R", "G", "B", "A"}, layers);
}

// As shaders/field_numbers.glsl reads them: for every colour channel the base colour and the shared numbers.
std::shared_ptr<const FloatImage> packedShared(const ReflectanceField& field) {
  const ReflectanceModel& model = field.model();
  const int channels = model.colorChannels();
  auto packed = std::make_shared<FloatImage>(rgbaLayers(field, channels * sharedTexels(model)));
  const int numbers = static_cast<int>(model.sharedNumbers().size());
  for (int c = 0; c < channels; ++c) {
    packNumbers(field.shared(), 0, 0, 3, *packed, c * sharedTexels(model), 0);
    packNumbers(field.shared(), 0, 3 + c * numbers, numbers, *packed, c * sharedTexels(model), 3);
  }
  packed->setPrecision(field.shared().precision());
  return packed;
}

// For every layer and colour channel the numbers, padded to whole texels.
std::shared_ptr<FloatImage> packedLayers(const ReflectanceField& field, const FloatImage& from) {
  const ReflectanceModel& model = field.model();
  const int channels = model.colorChannels();
  const int numbers = static_cast<int>(model.layerNumbers().size());
  const int layers = field.layers().layers();
  auto packed = std::make_shared<FloatImage>(rgbaLayers(field, layers * channels * layerTexels(model)));
  for (int layer = 0; layer < layers; ++layer)
    for (int c = 0; c < channels; ++c)
      packNumbers(from, layer, c * numbers, numbers, *packed, (layer * channels + c) * layerTexels(model), 0);
  packed->setPrecision(field.layers().precision());
  return packed;
}

const char* decodeFunction(Encoding encoding) {
  switch (encoding) {
    case Encoding::Linear:
      return "";
    case Encoding::Gamma22:
      return "decodeGamma22";
    case Encoding::Srgb:
      return "decodeSrgb";
  }
  return "";
}

ShaderSource sourceFor(const ReflectanceField& field, const BTFMaterialOptions& options) {
  const ReflectanceModel& model = field.model();
  ShaderSource source{.vertex = "mesh.vert", .fragment = "btf.frag"};
  for (const auto& define : model.shaderDefines()) source.defines.push_back(define);
  source.defines.emplace_back("COLOR_CHANNELS", std::to_string(model.colorChannels()));
  source.defines.emplace_back("SHARED_TEXELS", std::to_string(sharedTexels(model)));
  source.defines.emplace_back("LAYER_TEXELS", std::to_string(layerTexels(model)));
  source.defines.emplace_back("DECODE", decodeFunction(field.description().encoding));
  if (model.layerDirections() == LayerDirections::Lights)
    source.defines.emplace_back("LAYERS_ARE_LIGHTS", "");
  if (field.description().hasCosine) source.defines.emplace_back("MODEL_HAS_COSINE", "");
  if (!field.formula().integratesEnvironments()) source.defines.emplace_back("ENVIRONMENT_BY_QUADRATURE", "");
  if (options.interpolatedViews == 1) source.defines.emplace_back("NEAREST_LAYER", "");
  if (options.filter == TexelFilter::Bilinear) source.defines.emplace_back("BILINEAR", "");
  source.includeAliases["model.glsl"] = model.shaderFile();
  return source;
}

// The layers' numbers, and the tables that find them.
void setLayerChunks(BTFMaterial& material, const ReflectanceField& field) {
  const LayerLookup lookup = LayerLookup::create(field.formula().triangulation());
  material.setChunk(textureSlot(0),
                    std::make_shared<TextureChunk>(packedLayers(field, field.layers()),
                                                   TextureOptions{.shape = TextureShape::Array}));
  material.setChunk(textureSlot(2), std::make_shared<CubeTextureChunk>(
                                        std::make_shared<const FloatImage>(lookup.triangleOfDirection)));
  material.setChunk(textureSlot(3),
                    std::make_shared<TextureChunk>(std::make_shared<const FloatImage>(lookup.triangles),
                                                   TextureOptions{.shape = TextureShape::Rectangle}));
}

// The layers as environments are asked for them; empty where the model has no such numbers.
FloatImage preparedLayers(const ReflectanceField& field) {
  const auto channels = static_cast<std::size_t>(field.model().colorChannels());
  const std::size_t numbers = field.model().layerNumbers().size();
  FloatImage layers = field.layers();
  for (int layer = 0; layer < layers.layers(); ++layer)
    for (int y = 0; y < layers.height(); ++y)
      for (int x = 0; x < layers.width(); ++x)
        for (std::size_t c = 0; c < channels; ++c)
          if (!field.model().prepareForEnvironments(layers.texel(x, y, layer).subspan(c * numbers, numbers)))
            return {};
  return layers;
}

// A texel a node: the light, and its weight.
std::shared_ptr<const FloatImage> nodesOf(const LightQuadrature& quadrature) {
  auto nodes = std::make_shared<FloatImage>(static_cast<int>(quadrature.nodes.size()), 1,
                                            std::vector<std::string>{"x", "y", "z", "w"});
  for (int i = 0; i < nodes->width(); ++i) {
    const auto& [light, weight] = quadrature.nodes[static_cast<std::size_t>(i)];
    std::ranges::copy(std::array{light.x, light.y, light.z, weight}, nodes->texel(i, 0).begin());
  }
  return nodes;
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
  const int layers =
      field->formula().layerCount() * field->model().colorChannels() * layerTexels(field->model());
  if (layers > kMaximumLayers)
    return fail(fmt::format("the field needs {} texture layers of at most {}", layers, kMaximumLayers));

  std::shared_ptr<BTFMaterial> material(new BTFMaterial(field));
  const FloatImage prepared = options.preparedForEnvironments && field->formula().integratesEnvironments()
                                  ? preparedLayers(*field)
                                  : FloatImage();
  ShaderSource source = sourceFor(*field, options);
  if (!prepared.empty()) source.defines.emplace_back("ENVIRONMENT_LAYERS", "");
  material->setChunk(ProgramSlot, std::make_shared<ProgramChunk>(std::move(source)));
  if (layers > 0) setLayerChunks(*material, *field);
  material->setChunk(textureSlot(1), std::make_shared<TextureChunk>(
                                         packedShared(*field), TextureOptions{.shape = TextureShape::Array}));
  material->setChunk(uniformSlot(2),
                     std::make_shared<UniformBlockChunk>(blockBytes(FieldBlock{
                         options.textureScale, field->formula().lowestLightZ(),
                         field->formula().lowestViewZ(), field->formula().quadrature().exponent})));
  if (!prepared.empty()) {
    auto packed = packedLayers(*field, prepared);
    if (prepared.precision() == Precision::Half) packed->roundToHalf();
    material->setChunk(textureSlot(5),
                       std::make_shared<TextureChunk>(std::shared_ptr<const FloatImage>(std::move(packed)),
                                                      TextureOptions{.shape = TextureShape::Array}));
  }
  if (!field->formula().integratesEnvironments())
    material->setChunk(textureSlot(4),
                       std::make_shared<TextureChunk>(nodesOf(field->formula().quadrature()),
                                                      TextureOptions{.shape = TextureShape::Rectangle}));
  if (options.doubleSided) material->setChunk(RasterSlot, std::make_shared<RasterChunk>(Culling::None));
  return material;
}

}  // namespace weft
