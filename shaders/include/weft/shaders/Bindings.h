#pragma once

/// Texture units and bindings of uniform blocks, as GLSL names them.
namespace weft::bindings {
#include "weft/shaders/bindings.glsl"
}  // namespace weft::bindings
