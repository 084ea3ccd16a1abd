#pragma once

#include <memory>

#include "weft/chunks/GLContext.h"
#include "weft/chunks/GLName.h"
#include "weft/scenegraph/Mesh.h"

namespace weft {

/// A mesh in one GL context, with the attribute locations of shaders/mesh.vert.
struct MeshObjects {
  GLVertexArray array;
  GLBuffer vertices;
  GLBuffer indices;
  GLenum mode = GL_TRIANGLES;
  GLsizei indexCount = 0;
};

/// Made at the first call; one for all geometries that share the mesh.
const MeshObjects& meshObjects(GLContext& context, const std::shared_ptr<const Mesh>& mesh);

}  // namespace weft
