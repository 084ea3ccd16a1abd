#pragma once

#include <compare>
#include <map>
#include <string>

#include "weft/shaders/ShaderDefines.h"

namespace weft {

/// What every program of a frame is made with beside its own ShaderSource.
struct ShaderVariant {
  ShaderDefines defines{};
  std::map<std::string, std::string> includeAliases{};  ///< where a source has none of that name

  auto operator<=>(const ShaderVariant&) const = default;
};

}  // namespace weft
