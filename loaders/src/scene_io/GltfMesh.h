#pragma once

#include <memory>

#include "GltfFile.h"
#include "weft/scenegraph/Mesh.h"

namespace weft {

/// One primitive made of triangles, with all attributes; normals and tangents are generated where the file
/// has none.
Result<std::shared_ptr<const Mesh>> readMesh(const GltfFile& file, const tinygltf::Primitive& primitive);

}  // namespace weft
