#pragma once

#include <memory>

#include "SceneGrid.h"

namespace weft::bench {

std::unique_ptr<Side> makeOsgScene(const SceneGrid& grid);

}  // namespace weft::bench
