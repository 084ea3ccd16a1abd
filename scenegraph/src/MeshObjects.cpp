#include "MeshObjects.h"

#include <algorithm>

namespace weft {

namespace {

/// Fills one attribute from its part of the vertex buffer and returns where the next part starts.
template <class Vector>
GLintptr addAttribute(const MeshObjects& objects, GLuint location, const std::vector<Vector>& values,
                      GLintptr offset) {
  const auto bytes = static_cast<GLsizeiptr>(values.size() * sizeof(Vector));
  glNamedBufferSubData(objects.vertices, offset, bytes, values.data());
  glVertexArrayVertexBuffer(objects.array, location, objects.vertices, offset, sizeof(Vector));
  glVertexArrayAttribFormat(objects.array, location, Vector::length(), GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(objects.array, location, location);
  glEnableVertexArrayAttrib(objects.array, location);
  return offset + bytes;
}

void expectValid(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  WEFT_EXPECT(mesh.normals.size() == count && mesh.tangents.size() == count && mesh.texcoords.size() == count,
              "every attribute of a mesh has a value for every position");
  WEFT_EXPECT(mesh.indices.size() % 3 == 0 && std::all_of(mesh.indices.begin(), mesh.indices.end(),
                                                          [&](std::uint32_t i) { return i < count; }),
              "a mesh's indices are triples of existing vertices");
}

void make(MeshObjects& objects, const Mesh& mesh) {
  objects.array = createGL<GLVertexArray>(glCreateVertexArrays);
  objects.vertices = createGL<GLBuffer>(glCreateBuffers);
  objects.indices = createGL<GLBuffer>(glCreateBuffers);
  constexpr std::size_t kVertexBytes = 2 * sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(glm::vec2);
  glNamedBufferStorage(objects.vertices, static_cast<GLsizeiptr>(mesh.positions.size() * kVertexBytes),
                       nullptr, GL_DYNAMIC_STORAGE_BIT);
  GLintptr offset = addAttribute(objects, 0, mesh.positions, 0);
  offset = addAttribute(objects, 1, mesh.normals, offset);
  offset = addAttribute(objects, 2, mesh.tangents, offset);
  addAttribute(objects, 3, mesh.texcoords, offset);

  glNamedBufferStorage(objects.indices, static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)),
                       mesh.indices.data(), 0);
  glVertexArrayElementBuffer(objects.array, objects.indices);
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
