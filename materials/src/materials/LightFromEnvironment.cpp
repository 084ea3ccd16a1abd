#include "weft/materials/LightFromEnvironment.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "weft/chunks/DepthChunk.h"
#include "weft/chunks/ProgramChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/materials/ChunkMaterial.h"
#include "weft/reflectance/MicrofacetTable.h"
#include "weft/shaders/Bindings.h"

namespace weft {
namespace {

constexpr int kParabolicSize = 128;
constexpr int kParabolicExponents = 11;

/// With a fourth channel: what is filtered in hardware has a power of two bytes a texel.
std::shared_ptr<const FloatImage> withAlpha(const FloatImage& rgb) {
  auto image = std::make_shared<FloatImage>(rgb.width(), rgb.height(),
                                            std::vector<std::string>{"R", "G", "B", "A"}, rgb.layers());
  const auto from = rgb.values();
  const auto to = image->values();
  for (std::size_t texel = 0; texel < from.size() / 3; ++texel)
    for (std::size_t c = 0; c < 3; ++c) to[4 * texel + c] = from[3 * texel + c];
  image->setPrecision(rgb.precision());
  return image;
}

std::shared_ptr<TextureChunk> smooth(std::shared_ptr<const FloatImage> image, TextureShape shape) {
  return std::make_shared<TextureChunk>(std::move(image),
                                        TextureOptions{.shape = shape, .filter = TextureFilter::Linear});
}

/// Bilinear in one layer of an octahedral map.
glm::vec3 lookUp(const FloatImage& maps, glm::vec3 direction, int layer) {
  const auto size = static_cast<float>(maps.width());
  const glm::vec2 at = (0.5f + 0.5f * OctahedralMap::place(direction) * (1.0f - 2.0f / size)) * size - 0.5f;
  const glm::ivec2 low = glm::clamp(glm::ivec2(glm::floor(at)), 0, maps.width() - 2);
  const glm::vec2 share = at - glm::vec2(low);
  glm::vec3 value;
  for (int c = 0; c < 3; ++c)
    value[c] = glm::mix(
        glm::mix(maps.at(low.x, low.y, c, layer), maps.at(low.x + 1, low.y, c, layer), share.x),
        glm::mix(maps.at(low.x, low.y + 1, c, layer), maps.at(low.x + 1, low.y + 1, c, layer), share.x),
        share.y);
  return value;
}

/// Two parabolic maps for each exponent 2^(i / 2), around +z and -z, in a column, with a border of
/// a texel.
std::shared_ptr<const FloatImage> parabolicMaps(const PrefilteredEnvironment& prefiltered) {
  auto image = std::make_shared<FloatImage>(kParabolicSize, 2 * kParabolicExponents * kParabolicSize,
                                            std::vector<std::string>{"R", "G", "B", "A"});
  for (int map = 0; map < 2 * kParabolicExponents; ++map)
    for (int y = 0; y < kParabolicSize; ++y)
      for (int x = 0; x < kParabolicSize; ++x) {
        const glm::vec2 p = (2.0f * (glm::vec2(x, y) + 0.5f) / static_cast<float>(kParabolicSize) - 1.0f) /
                            (1.0f - 2.0f / static_cast<float>(kParabolicSize));
        const float squared = glm::dot(p, p);
        const float z = (1.0f - squared) * (map % 2 == 0 ? 1.0f : -1.0f);
        const glm::vec3 value = lookUp(prefiltered.lobes, glm::vec3(2.0f * p, z),
                                       map / 2 * PrefilteredEnvironment::kLobesPerOctave / 2);
        for (int c = 0; c < 3; ++c) image->at(x, map * kParabolicSize + y, c) = value[c];
      }
  image->roundToHalf();
  return image;
}

std::shared_ptr<const Material> backgroundOf(const Environment& environment) {
  auto background = std::make_shared<ChunkMaterial>();
  background->setChunk(ProgramSlot,
                       std::make_shared<ProgramChunk>(ShaderSource{"background.vert", "background.frag"}));
  background->setChunk(DepthSlot, std::make_shared<DepthChunk>(true, false));
  background->setChunk(textureSlot(bindings::panoramaUnit),
                       std::make_shared<TextureChunk>(std::make_shared<const FloatImage>(environment.image()),
                                                      TextureOptions{.filter = TextureFilter::Linear,
                                                                     .wrap = TextureWrap::Repeat,
                                                                     .wrapV = TextureWrap::Clamp}));
  return background;
}

}  // namespace

std::shared_ptr<EnvironmentLight> makeEnvironmentLight(const Environment& environment,
                                                       const PrefilteredEnvironment& prefiltered,
                                                       LobeLookup lookup) {
  State lighting;
  ShaderVariant variant{.defines = {{"ENVIRONMENT", ""}}};
  if (lookup == LobeLookup::Paper) {
    lighting.set(textureSlot(bindings::environmentLobesUnit),
                 smooth(parabolicMaps(prefiltered), TextureShape::Rectangle));
    variant.includeAliases["lobes.glsl"] = "lobes_paper.glsl";
  } else {
    lighting.set(textureSlot(bindings::environmentLobesUnit),
                 smooth(withAlpha(prefiltered.lobes), TextureShape::ThreeDimensional));
    variant.defines.emplace_back("ENVIRONMENT_LOBES",
                                 std::to_string(PrefilteredEnvironment::kLobesPerOctave));
  }
  lighting.set(textureSlot(bindings::environmentMomentsUnit),
               smooth(withAlpha(prefiltered.moments), TextureShape::ThreeDimensional));
  lighting.set(textureSlot(bindings::environmentGlossyUnit),
               smooth(withAlpha(prefiltered.glossy), TextureShape::ThreeDimensional));
  lighting.set(
      textureSlot(bindings::microfacetTableUnit),
      smooth(std::make_shared<const FloatImage>(MicrofacetTable().image()), TextureShape::TwoDimensional));
  return std::make_shared<EnvironmentLight>(std::move(lighting), std::move(variant),
                                            backgroundOf(environment), prefiltered.scale);
}

}  // namespace weft
