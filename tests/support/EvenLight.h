#pragma once

#include <algorithm>
#include <memory>

#include "weft/materials/LightFromEnvironment.h"
#include "weft/reflectance/PrefilteredEnvironment.h"

namespace weft::test {

/// The same light from everywhere, which needs no filtering. Its moments are not those of a
/// surface.
inline std::shared_ptr<EnvironmentLight> evenLight() {
  using P = PrefilteredEnvironment;
  const auto ones = [](OctahedralMap map, int layers) {
    FloatImage image(map.imageSize(), map.imageSize(), {"R", "G", "B"}, layers);
    std::ranges::fill(image.values(), 1.0f);
    return image;
  };
  return makeEnvironmentLight(Environment::constant(glm::vec3(1.0f)),
                              {ones(P::kLobeMap, P::kLobeLayers), ones(P::kLobeMap, P::kMomentLayers),
                               ones(P::kGlossyMap, P::kGlossyLayers), 1.0f});
}

}  // namespace weft::test
