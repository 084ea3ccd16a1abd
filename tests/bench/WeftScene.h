#pragma once

#include <memory>

#include "SceneGrid.h"

namespace weft::bench {

std::unique_ptr<Side> makeWeftScene(const SceneGrid& grid);

}  // namespace weft::bench
