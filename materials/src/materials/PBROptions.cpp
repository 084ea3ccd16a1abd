#include "weft/materials/PBROptions.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace weft {
namespace {

/// In the order of their units.
template <class Options>
auto listOfTextures(Options& options) {
  return std::array{&options.baseColorTexture,
                    &options.metallicRoughnessTexture,
                    &options.normalTexture,
                    &options.emissionTexture,
                    &options.occlusionTexture,
                    &options.specularTexture,
                    &options.specularColorTexture,
                    &options.clearcoat.texture,
                    &options.clearcoat.roughnessTexture,
                    &options.clearcoat.normalTexture,
                    &options.sheen.colorTexture,
                    &options.sheen.roughnessTexture,
                    &options.anisotropy.texture,
                    &options.iridescence.texture,
                    &options.iridescence.thicknessTexture,
                    &options.transmission.texture};
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

std::array<PBRTexture*, bindings::pbrUnitCount> texturesOf(PBROptions& options) {
  return listOfTextures(options);
}

std::array<const PBRTexture*, bindings::pbrUnitCount> texturesOf(const PBROptions& options) {
  return listOfTextures(options);
}

}  // namespace weft
