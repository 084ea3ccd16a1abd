#pragma once

#include <string>
#include <vector>

#include "weft/scene_io/SceneSetup.h"

namespace weft {

/// A line for each measured material whose sample repeats so seldom, or so often, over what the
/// camera sees, that it looks like a plain colour or a blur. A field of one view shows one thing,
/// once.
std::vector<std::string> repetitionWarnings(const Node& root, const Camera& camera,
                                            const SceneOptions& options);

}  // namespace weft
