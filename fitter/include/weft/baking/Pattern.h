#pragma once

#include <string_view>
#include <vector>

#include "weft/baking/HeightField.h"
#include "weft/core/Result.h"

namespace weft {

/// The names that makePattern() knows: "corduroy", "weave", "tiles", "bumps".
const std::vector<std::string_view>& patternNames();

/// A procedural surface of `resolution` x `resolution` samples with mean height 0 and a period of
/// 1, the same on every run. Fails on an unknown name.
Result<HeightField> makePattern(std::string_view name, int resolution);

}  // namespace weft
