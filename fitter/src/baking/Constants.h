#pragma once

#include <limits>
#include <numbers>

namespace weft {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace weft
