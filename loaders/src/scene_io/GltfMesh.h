#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <span>

#include "GltfFile.h"
#include "GltfMaterials.h"
#include "weft/scenegraph/Mesh.h"

namespace weft {

/// How a mesh stands: what its vertices are changed by when they are read.
struct MeshPose {
  std::vector<float> morphWeights{};  ///< one a morph target; those left out are 0
  std::vector<glm::mat4> joints{};    ///< of the skin, of the vertices; empty: not skinned
};

/// What its material must know of a primitive; how it is lit: glTF 2.0, 3.9.5.
Wearer wearerOf(const GltfFile& file, const tinygltf::Primitive& primitive);

/// A text that is the same for primitives that become the same mesh, but for a skin.
std::string meshKey(const tinygltf::Primitive& primitive, const MeshDress& dress, const MeshPose& pose);

/// One primitive as lists of triangles, lines or points, with all attributes; normals and tangents
/// are generated, in the pose, where the file has none that fit. `taken`: the memory of all meshes,
/// to which this one's is added. `warnings`: gets what the file lacks.
Result<std::shared_ptr<const Mesh>> readMesh(const GltfFile& file, const tinygltf::Primitive& primitive,
                                             const MeshDress& dress, const MeshPose& pose, std::size_t& taken,
                                             std::vector<std::string>& warnings);

}  // namespace weft
