#pragma once

#include <glm/mat4x4.hpp>

#include "GltfFile.h"

namespace weft {

constexpr const char* kInstancingExtension = "EXT_mesh_gpu_instancing";

/// Where the instances of a node's mesh stand, below the node.
Result<std::vector<glm::mat4>> instancesOf(const GltfFile& file, const tinygltf::Value& extension);

}  // namespace weft
