#pragma once

#include <span>
#include <string_view>

namespace weft {

/// One GLSL file of the folder `shaders/`, compiled into the program.
struct EmbeddedShader {
  std::string_view name;  ///< "btf.frag"
  std::string_view text;
};

std::span<const EmbeddedShader> embeddedShaders();

}  // namespace weft
