#pragma once

#include <string>
#include <utility>
#include <vector>

namespace weft {

/// `#define NAME VALUE`, after `#version`.
using ShaderDefines = std::vector<std::pair<std::string, std::string>>;

}  // namespace weft
