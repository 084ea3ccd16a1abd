#pragma once

// tinygltf, compiled by TinyGltf.cpp into a namespace of our own. Other libraries of a program hold
// other versions of it under the same names (Debian's Draco does), and of functions with one name
// the linker takes the first it meets, for all.
#define tinygltf weft_tinygltf
// Images are decoded by weft/io.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
#undef tinygltf

namespace weft {

namespace tinygltf = ::weft_tinygltf;

}  // namespace weft
