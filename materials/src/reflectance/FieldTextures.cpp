#include "weft/reflectance/FieldTextures.h"

#include <algorithm>
#include <array>

#include "weft/shaders/Bindings.h"

namespace weft {
namespace {

// Calls of(x, y, layer) for every texel.
template <class Function>
void forEachTexel(const FloatImage& image, Function of) {
  for (int layer = 0; layer < image.layers(); ++layer)
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) of(x, y, layer);
}

// A byte a shared number: those that the hardware filters, of levels that stand for themselves or
// are summed.
bool areBytes(const ReflectanceModel& model) {
  return model.filtersParameters() || model.summedLevels() > 0;
}

int levelsOf(const ReflectanceField& field) {
  return static_cast<int>(field.levels().size());
}

TextureImage packShared(const ReflectanceField& field) {
  const ReflectanceModel& model = field.model();
  const int texels = FieldTextures::sharedTexels(model), channels = model.colorChannels();
  const std::size_t numbers = model.sharedParameters().size();
  TextureImage packed(field.width(), field.height(), channels * texels, 4,
                      texelType(field.shared().precision()), levelsOf(field));
  for (int level = 0; level < levelsOf(field); ++level) {
    const FloatImage& from = field.levels()[static_cast<std::size_t>(level)].shared;
    forEachTexel(from, [&](int x, int y, int) {
      const std::span<const float> values = from.texel(x, y);
      for (int c = 0; c < channels; ++c) {
        packed.set(x, y, c * texels, 0, values.first(3), level);
        packed.set(x, y, c * texels, 3, values.subspan(3 + static_cast<std::size_t>(c) * numbers, numbers),
                   level);
      }
    });
  }
  return packed;
}

// `change(numbers)` of each colour channel of each layer.
template <class Change>
TextureImage packLayers(const ReflectanceField& field, Change change) {
  const int layers = field.formula().storedLayers();
  if (layers == 0) return {};
  const ReflectanceModel& model = field.model();
  const int texels = FieldTextures::layerTexels(model), channels = model.colorChannels();
  const std::size_t numbers = model.layerParameters().size();
  TextureImage packed(field.width(), field.height(), layers * channels * texels, 4,
                      texelType(field.layers().precision()), levelsOf(field));
  for (int level = 0; level < levelsOf(field); ++level) {
    const FloatImage& from = field.levels()[static_cast<std::size_t>(level)].layers;
    forEachTexel(from, [&](int x, int y, int layer) {
      const std::span<const float> values = from.texel(x, y, layer);
      for (int c = 0; c < channels; ++c)
        packed.set(x, y, (layer * channels + c) * texels, 0,
                   change(values.subspan(static_cast<std::size_t>(c) * numbers, numbers)), level);
    });
  }
  return packed;
}

TextureImage packPreparedLayers(const ReflectanceField& field) {
  std::vector<float> prepared(field.model().layerParameters().size());
  return packLayers(field, [&](std::span<const float> numbers) {
    std::ranges::copy(numbers, prepared.begin());
    field.model().prepareForEnvironments(prepared);
    return std::span<const float>(prepared);
  });
}

int tableTexels(const FloatImage& table) {
  return (table.channelCount() + 3) / 4;
}

TextureImage packTable(const FloatImage& table) {
  TextureImage packed(table.width(), table.height(), tableTexels(table), 4, texelType(table.precision()));
  forEachTexel(table, [&](int x, int y, int) { packed.set(x, y, 0, 0, table.texel(x, y)); });
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

FloatImage nodesOf(const LightQuadrature& quadrature) {
  if (quadrature.nodes.empty()) return {};
  FloatImage nodes(static_cast<int>(quadrature.nodes.size()), 1, {"x", "y", "z", "w"});
  for (int i = 0; i < nodes.width(); ++i) {
    const auto& [light, weight] = quadrature.nodes[static_cast<std::size_t>(i)];
    std::ranges::copy(std::array{light.x, light.y, light.z, weight}, nodes.texel(i, 0).begin());
  }
  return nodes;
}

std::map<std::string, std::string> aliasesOf(const FieldFormula& formula) {
  const bool ofLights = formula.model().layerDirections() == LayerDirections::Lights;
  const bool isFiltered = formula.model().filtersParameters();
  const bool isSummed = formula.model().summedLevels() > 0;
  return {{"model.glsl", formula.model().shaderFile()},
          {"fetch.glsl", isSummed     ? "fetch_levels.glsl"
                         : isFiltered ? "fetch_filtered.glsl"
                                      : "fetch_texel.glsl"},
          {"shade.glsl", ofLights ? "shade_lights.glsl" : "shade_views.glsl"},
          {"surroundings.glsl",
           formula.integratesEnvironments() ? "surroundings_formula.glsl" : "surroundings_quadrature.glsl"}};
}

// How many fours of numbers behind the base colour are needed to hold what is not 0; at least two,
// where there are as many: the first may be those of a lobe, and the shader's loops begin behind.
int foursNeeded(const FloatImage& shared) {
  int needed = std::min((shared.channelCount() - 3 + 3) / 4, 2);
  forEachTexel(shared, [&](int x, int y, int) {
    const std::span<const float> numbers = shared.texel(x, y).subspan(3);
    const auto last =
        std::ranges::find_if(numbers.rbegin(), numbers.rend(), [](float w) { return w != 0.0f; });
    needed = std::max(needed, static_cast<int>(numbers.rend() - last + 3) / 4);
  });
  return needed;
}

std::array<std::int32_t, 16> weightsOfLevels(const ReflectanceField& field) {
  std::array<std::int32_t, 16> weights{};
  const std::size_t coarsest = field.levels().size() - 1;
  for (std::size_t level = 0; level < weights.size(); ++level)
    weights[level] = level <= coarsest ? foursNeeded(field.levels()[level].shared) : weights[coarsest];
  return weights;
}

std::uint64_t textureBytes(const FloatImage& image, int arrayLayers, std::uint64_t texelBytes) {
  return texelBytes * static_cast<std::uint64_t>(image.width()) * static_cast<std::uint64_t>(image.height()) *
         static_cast<std::uint64_t>(arrayLayers);
}

}  // namespace

namespace {

// `numbers(texel)` of each of some fields that filter them, behind one another.
template <class Numbers>
TextureImage packBehind(std::initializer_list<std::span<const FieldLevel>> fields, int layers, int channels,
                        TexelType type, Numbers numbers) {
  const std::span<const FieldLevel> first = *fields.begin();
  TextureImage packed(first[0].shared.width(), first[0].shared.height(),
                      layers * static_cast<int>(fields.size()), channels, type,
                      static_cast<int>(first.size()));
  for (int level = 0; level < packed.levels(); ++level) {
    int layer = 0;
    for (const std::span<const FieldLevel> field : fields) {
      const FloatImage& from = field[static_cast<std::size_t>(level)].shared;
      forEachTexel(from,
                   [&](int x, int y, int) { packed.set(x, y, layer, 0, numbers(from.texel(x, y)), level); });
      layer += layers;
    }
  }
  return packed;
}

}  // namespace

TextureImage packBaseColors(std::initializer_list<std::span<const FieldLevel>> fields) {
  return packBehind(fields, 1, 3, TexelType::SharedExponent,
                    [](std::span<const float> texel) { return texel.first(3); });
}

TextureImage packFilteredNumbers(std::initializer_list<std::span<const FieldLevel>> fields) {
  const int numbers = fields.begin()->front().shared.channelCount() - 3;
  return packBehind(fields, (numbers + 3) / 4, 4, TexelType::SignedByte,
                    [](std::span<const float> texel) { return texel.subspan(3); });
}

FieldTextures FieldTextures::create(const ReflectanceField& field, bool preparedForEnvironments) {
  const bool isFiltered = field.model().filtersParameters();
  FieldTextures textures{areBytes(field.model()) ? packFilteredNumbers({field.levels()}) : packShared(field),
                         packLayers(field, [](std::span<const float> numbers) { return numbers; }),
                         {},
                         isFiltered ? packBaseColors({field.levels()}) : TextureImage()};
  for (const auto& [name, table] : field.tables()) textures.tables[name] = packTable(table);
  if (preparedForEnvironments && canBePrepared(field.formula()))
    textures.preparedLayers = packPreparedLayers(field);
  return textures;
}

int FieldTextures::sharedTexels(const ReflectanceModel& model) {
  const int besideBaseColor = static_cast<int>(model.sharedParameters().size());
  return ((areBytes(model) ? 0 : 3) + besideBaseColor + 3) / 4;
}

int FieldTextures::layerTexels(const ReflectanceModel& model) {
  return (static_cast<int>(model.layerParameters().size()) + 3) / 4;
}

int FieldTextures::arrayLayers(const FieldFormula& formula) {
  return formula.storedLayers() * formula.model().colorChannels() * layerTexels(formula.model());
}

bool FieldTextures::canBePrepared(const FieldFormula& formula) {
  std::vector<float> numbers(formula.model().layerParameters().size());
  return formula.integratesEnvironments() && !numbers.empty() &&
         formula.model().prepareForEnvironments(numbers);
}

std::uint64_t gpuBytes(const ReflectanceField& field) {
  const ReflectanceModel& model = field.model();
  const auto texelBytes = [](const FloatImage& image) -> std::uint64_t {
    return image.precision() == Precision::Half ? 8 : 16;
  };
  const int sharedLayers = model.colorChannels() * FieldTextures::sharedTexels(model);
  std::uint64_t bytes = 0;
  for (const FieldLevel& level : field.levels()) {
    if (areBytes(model))
      bytes += textureBytes(level.shared, sharedLayers + (model.filtersParameters() ? 1 : 0), 4);
    else
      bytes += textureBytes(level.shared, sharedLayers, texelBytes(level.shared));
    bytes +=
        textureBytes(level.layers, FieldTextures::arrayLayers(field.formula()), texelBytes(level.layers));
  }
  for (const auto& [name, table] : field.tables())
    bytes += textureBytes(table, tableTexels(table), texelBytes(table));
  return bytes;
}

FieldProgram FieldProgram::create(const ReflectanceField& field) {
  const ReflectanceModel& model = field.model();
  const FieldFormula& formula = field.formula();
  FieldProgram program{.defines = model.shaderDefines(),
                       .includeAliases = aliasesOf(formula),
                       .texts = {},
                       .block = {.lowestLightZ = formula.lowestLightZ(),
                                 .lowestViewZ = formula.lowestViewZ(),
                                 .quadratureExponent = formula.quadrature().exponent},
                       .lookup = {},
                       .quadrature = nodesOf(formula.quadrature())};
  program.defines["COLOR_CHANNELS"] = std::to_string(model.colorChannels());
  program.defines["SHARED_TEXELS"] = std::to_string(FieldTextures::sharedTexels(model));
  program.defines["LAYER_TEXELS"] = std::to_string(FieldTextures::layerTexels(model));
  program.defines["DECODE"] = decodeFunction(field.description().encoding);
  if (model.filtersParameters()) program.block.weightsOfLevels = weightsOfLevels(field);
  if (field.description().hasCosine) program.defines["MODEL_HAS_COSINE"] = "";
  if (const std::string text = model.shaderText(); !text.empty()) program.texts[model.shaderFile()] = text;
  int unit = bindings::firstTableUnit;
  for (const auto& [name, table] : field.tables()) program.defines["TABLE_" + name] = std::to_string(unit++);
  if (formula.layerCount() > 0) {
    program.defines["HAS_LAYERS"] = "";
    program.lookup = LayerLookup::create(formula.triangulation());
  }
  return program;
}

}  // namespace weft
