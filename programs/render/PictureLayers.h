#pragma once

#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/scenegraph/RenderAction.h"

namespace weft {

/// The names that addLayers() takes: normal, depth, albedo, uv.
std::vector<std::string> layerNames();

/// A picture with more channels, as layers of an EXR file: what ShownValue says, of the middle of
/// each pixel, 0 where nothing is. normal.X, .Y, .Z; depth.Z; albedo.R, .G, .B; uv.U, .V.
Result<FloatImage> addLayers(const FloatImage& picture, const std::vector<std::string>& names,
                             GLContext& context, RenderAction& renderer, const Node& root,
                             const Camera& camera);

}  // namespace weft
