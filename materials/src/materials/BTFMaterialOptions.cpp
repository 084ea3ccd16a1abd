#include "weft/materials/BTFMaterialOptions.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/vector_relational.hpp>

namespace weft {
namespace {

constexpr float kLargestFactor = 1e30f;

}  // namespace

Result<void> checkOptions(const BTFMaterialOptions& options, const BTFTextures& textures) {
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
  if (options.tiling == Tiling::Stochastic && !textures.tilesAtRandom())
    return fail("the model of this reflectance field cannot be tiled at random", {},
                "a fit with loom, or a coordinate map, as weft-synth makes them");
  return {};
}

}  // namespace weft
