#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "RangeAllocator.h"
#include "weft/chunks/GLContext.h"
#include "weft/chunks/GLName.h"
#include "weft/scenegraph/Mesh.h"

namespace weft {

/// Vertex array binding points and attribute locations of shaders/mesh.vert.
constexpr GLuint kVertexBinding = 0;
/// what meshes without a second texture coordinate or colours have
constexpr GLuint kAbsentBinding = 1;
constexpr GLuint kModelBinding = 2;  ///< ModelRows, one an instance
constexpr GLuint kModelLocation = 13;

/// A vertex and an index buffer that many meshes share, so that one draw call can draw all of them.
struct MeshPage {
  MeshPage(bool extended, std::uint32_t vertexCount, std::uint32_t indexCount, std::uint32_t pageNumber);

  bool extended;         ///< has the second texture coordinates and colours
  std::uint32_t number;  ///< in the order of making
  GLBuffer vertices;
  GLBuffer indices;
  GLBuffer absent;
  GLVertexArray array;
  RangeAllocator freeVertices;
  RangeAllocator freeIndices;
};

/// Where a mesh lies in the buffers of a context; gives the place back when it is destroyed.
struct MeshPlace {
  MeshPlace() = default;
  MeshPlace(const MeshPlace&) = delete;
  MeshPlace& operator=(const MeshPlace&) = delete;
  ~MeshPlace();

  std::shared_ptr<MeshPage> page;
  GLenum mode = GL_TRIANGLES;
  std::uint32_t firstVertex = 0, vertexCount = 0;
  std::uint32_t firstIndex = 0, indexCount = 0;
};

/// Puts a mesh into the buffers of the context at the first call; one place for all geometries that
/// share it. Its positions become relative to the middle of its bounds, so that floats suffice
/// wherever that is.
const MeshPlace& meshPlace(GLContext& context, const std::shared_ptr<const Mesh>& mesh);

}  // namespace weft
