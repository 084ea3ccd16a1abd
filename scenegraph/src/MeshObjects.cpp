#include "MeshObjects.h"

#include <algorithm>

namespace weft {

namespace {

/// Fills one attribute from its part of the vertex buffer and returns where the next part starts. A stride of
/// 0 gives the one value to every vertex.
template <class Vector>
GLintptr addAttribute(const MeshObjects& objects, GLuint location, const std::vector<Vector>& values,
                      GLintptr offset, GLsizei stride = sizeof(Vector)) {
  const auto bytes = static_cast<GLsizeiptr>(values.size() * sizeof(Vector));
  glNamedBufferSubData(objects.vertices, offset, bytes, values.data());
  glVertexArrayVertexBuffer(objects.array, location, objects.vertices, offset, stride);
  glVertexArrayAttribFormat(objects.array, location, Vector::length(), GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(objects.array, location, location);
  glEnableVertexArrayAttrib(objects.array, location);
  return offset + bytes;
}

/// The same for an attribute that a mesh may leave out: then all vertices have `otherwise`.
template <class Vector>
GLintptr addOptional(const MeshObjects& objects, GLuint location, const std::vector<Vector>& values,
                     Vector otherwise, GLintptr offset) {
  return values.empty() ? addAttribute(objects, location, std::vector<Vector>{otherwise}, offset, 0)
                        : addAttribute(objects, location, values, offset);
}

GLenum modeOf(Topology topology) {
  switch (topology) {
    case Topology::Triangles:
      return GL_TRIANGLES;
    case Topology::Lines:
      return GL_LINES;
    case Topology::Points:
      return GL_POINTS;
  }
  return GL_NONE;
}

void expectValid(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  WEFT_EXPECT(mesh.normals.size() == count && mesh.tangents.size() == count && mesh.texcoords.size() == count,
              "every attribute of a mesh has a value for every position");
  WEFT_EXPECT((mesh.texcoords1.empty() || mesh.texcoords1.size() == count) &&
                  (mesh.colors.empty() || mesh.colors.size() == count),
              "an attribute that a mesh has, it has for every position");
  WEFT_EXPECT(
      mesh.indices.size() % verticesPer(mesh.topology) == 0 &&
          std::all_of(mesh.indices.begin(), mesh.indices.end(), [&](std::uint32_t i) { return i < count; }),
      "a mesh's indices are whole triangles, lines or points of existing vertices");
}

void make(MeshObjects& objects, const Mesh& mesh) {
  objects.array = createGL<GLVertexArray>(glCreateVertexArrays);
  objects.vertices = createGL<GLBuffer>(glCreateBuffers);
  objects.indices = createGL<GLBuffer>(glCreateBuffers);
  constexpr std::size_t kVertexBytes = 2 * sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2);
  const std::size_t bytes = mesh.positions.size() * kVertexBytes +
                            std::max<std::size_t>(mesh.texcoords1.size(), 1) * sizeof(glm::vec2) +
                            std::max<std::size_t>(mesh.colors.size(), 1) * sizeof(glm::vec4);
  glNamedBufferStorage(objects.vertices, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  GLintptr offset = addAttribute(objects, 0, mesh.positions, 0);
  offset = addAttribute(objects, 1, mesh.normals, offset);
  offset = addAttribute(objects, 2, mesh.tangents, offset);
  offset = addAttribute(objects, 3, mesh.texcoords, offset);
  offset = addOptional(objects, 4, mesh.texcoords1, glm::vec2(0.0f), offset);
  addOptional(objects, 5, mesh.colors, glm::vec4(1.0f), offset);

  glNamedBufferStorage(objects.indices, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                       mesh.indices.data(), 0);
  glVertexArrayElementBuffer(objects.array, objects.indices);
  objects.mode = modeOf(mesh.topology);
  objects.indexCount = static_cast<GLsizei>(mesh.indices.size());
}

}  // namespace

const MeshObjects& meshObjects(GLContext& context, const std::shared_ptr<const Mesh>& mesh) {
  auto& objects = context.objectsOf<MeshObjects>(mesh);
  if (!objects.array) {
    expectValid(*mesh);
    make(objects, *mesh);
  }
  return objects;
}

}  // namespace weft
