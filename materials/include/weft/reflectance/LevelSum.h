#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// How much of level k counts at a level of detail: 1 of those above it, 0 of those below, and
/// between two a share ([Ma 2005] eq. 7). The levels of models that sum them
/// (ReflectanceModel::summedLevels()) are Laplacian: what the next coarser one, filtered, leaves.
float shareOfLevel(int level, float detail);

/// The level of detail at a distance, as multiples of that at which a texel of the finest level
/// covers a pixel; `levels` are 1 and more.
float detailAtDistance(float distance, int levels);

/// What such a model is evaluated with: the base colour of the finest level, then each level's
/// shared numbers times its share, the finest first. The place is in texels of the finest level,
/// where the centre of the first is at 0, 0. Levels are looked up bilinearly, as GL does, and
/// repeat.
void numbersOfLevels(std::span<const FieldLevel> levels, glm::vec2 place, float detail,
                     std::vector<float>& numbers);

}  // namespace weft
